/* gpu_renderdoc_capture_none.c: replaces gpu_renderdoc_capture.c in builds without RenderDoc's
 * header. */
#include "src/gpu/gpu_renderdoc_capture.h"

const char *gpu_capture_problem(void)
{
    return "this build lacks RenderDoc's header, renderdoc_app.h (Debian 12 has it in "
           "librenderdoc-dev); install it, then meson setup --reconfigure";
}

void gpu_capture_begin(const struct gpu *gpu)
{
    (void)gpu;
}

enum status gpu_capture_end(const struct gpu *gpu, char *path, size_t size)
{
    (void)gpu;
    (void)size;
    path[0] = '\0';
    return STATUS_WRITE;
}
