/*
 * fake_renderdoc.c: fake of RenderDoc's in-application API, loaded with LD_PRELOAD; it prints its
 * calls to stderr.
 */
#include <renderdoc_app.h>
#include <stdio.h>
#include <string.h>

static int began;

static void start(RENDERDOC_DevicePointer device, RENDERDOC_WindowHandle window)
{
    began = device && !window;
    fputs("capture begins\n", stderr);
}

static uint32_t end(RENDERDOC_DevicePointer device, RENDERDOC_WindowHandle window)
{
    fputs("capture ends\n", stderr);
    return began && device && !window;
}

static uint32_t count(void)
{
    return 1;
}

static uint32_t get(uint32_t index, char *path, uint32_t *length,
                    uint64_t *time) /* NOLINT(readability-non-const-parameter): RenderDoc's */
{
    static const char name[] = "/captures/frame 1.rdc";
    (void)time;
    if (path)
        memcpy(path, name, sizeof(name));
    *length = sizeof(name);
    return index == 0;
}

/* NOLINTBEGIN(readability-identifier-naming): the exported name of RenderDoc's API */
int RENDERDOC_CC RENDERDOC_GetAPI(RENDERDOC_Version version, void **api);

int RENDERDOC_CC RENDERDOC_GetAPI(RENDERDOC_Version version, void **api)
{
    static RENDERDOC_API_1_4_0 functions = {
        .StartFrameCapture = start,
        .EndFrameCapture = end,
        .GetNumCaptures = count,
        .GetCapture = get,
    };
    *api = &functions;
    return version == eRENDERDOC_API_Version_1_4_0;
}

/* NOLINTEND(readability-identifier-naming) */
