/* gpu_renderdoc_capture.c: triggers frame captures through RenderDoc's API, if its library is
 * loaded. */
#include "src/gpu/gpu_renderdoc_capture.h"

#include <renderdoc_app.h>
#include <stdio.h>
#include <string.h>

#include "src/base/loaded_library.h"
#include "src/base/log.h"

/* Returns RenderDoc's interface, or NULL if its library is not loaded. */
static RENDERDOC_API_1_4_0 *find_renderdoc(void)
{
    RENDERDOC_API_1_4_0 *api = NULL;
    pRENDERDOC_GetAPI get_api = NULL;
    void *symbol = loaded_library_find("renderdoc", "RENDERDOC_GetAPI");
    memcpy(&get_api, &symbol, sizeof(get_api)); /* ISO C forbids the cast */
    if (!get_api || get_api(eRENDERDOC_API_Version_1_4_0, (void **)&api) != 1)
        api = NULL;
    return api;
}

const char *gpu_capture_problem(void)
{
    return find_renderdoc() ? NULL
                            : "RenderDoc is not loaded; start firn from RenderDoc, or with "
                              "ENABLE_VULKAN_RENDERDOC_CAPTURE=1";
}

void gpu_capture_begin(const struct gpu *gpu)
{
    RENDERDOC_API_1_4_0 *api = find_renderdoc();
    if (api)
        api->StartFrameCapture(RENDERDOC_DEVICEPOINTER_FROM_VKINSTANCE(gpu->instance), NULL);
}

enum status gpu_capture_end(const struct gpu *gpu, char *path, size_t size)
{
    RENDERDOC_API_1_4_0 *api = find_renderdoc();
    uint32_t length = (uint32_t)size;
    path[0] = '\0';
    if (api &&
        api->EndFrameCapture(RENDERDOC_DEVICEPOINTER_FROM_VKINSTANCE(gpu->instance), NULL) == 1 &&
        api->GetNumCaptures() > 0 &&
        api->GetCapture(api->GetNumCaptures() - 1, NULL, &length, NULL) == 1 && length <= size &&
        api->GetCapture(api->GetNumCaptures() - 1, path, &length, NULL) == 1)
        return STATUS_OK;
    log_error("RenderDoc wrote no capture: see RenderDoc's log in the temporary directory");
    return STATUS_WRITE;
}
