/*
 * gpu_capture.h: captures of frames for RenderDoc, through its in-application interface.
 *
 * RenderDoc must be in the program before it opens a device: it starts programs with its library
 * loaded, or a Vulkan layer brings it (ENABLE_VULKAN_RENDERDOC_CAPTURE=1). Nothing here loads it.
 * Every pass and image appears there by its name.
 */
#ifndef FIRN_GPU_GPU_CAPTURE_H
#define FIRN_GPU_GPU_CAPTURE_H

#include "src/gpu/gpu.h"

/* Whether RenderDoc is there, once a device is open. */
bool gpu_capture_is_there(void);

/* Everything submitted from here on is captured, until gpu_capture_end(). */
void gpu_capture_begin(const struct gpu *gpu);

/* Writes the capture; its path goes to `path`. Logs why there is none: STATUS_WRITE. */
MUST_USE enum status gpu_capture_end(const struct gpu *gpu, char *path, size_t size);

#endif
