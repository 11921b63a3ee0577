/*
 * gpu_capture.h: captures of frames for RenderDoc, through its in-application interface.
 *
 * RenderDoc's library must be loaded before the program opens a device: RenderDoc does so in
 * programs that it starts, and its Vulkan layer does so with ENABLE_VULKAN_RENDERDOC_CAPTURE=1.
 * Nothing here loads it. Captures show every pass and image by its name.
 */
#ifndef FIRN_GPU_GPU_CAPTURE_H
#define FIRN_GPU_GPU_CAPTURE_H

#include "src/gpu/gpu.h"

/* Returns why there can be no capture, and how to mend it; NULL: there can be one. Call it when a
 * device is open. Static. */
const char *gpu_capture_trouble(void);

/* Begins to capture all submitted work, until gpu_capture_end(). */
void gpu_capture_begin(const struct gpu *gpu);

/* Ends the capture and writes its file, whose path it copies to `path` (`size` bytes). If there is
 * no capture, logs why and returns STATUS_WRITE. */
MUST_USE enum status gpu_capture_end(const struct gpu *gpu, char *path, size_t size);

#endif
