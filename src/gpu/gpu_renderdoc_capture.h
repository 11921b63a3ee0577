/*
 * gpu_renderdoc_capture.h: RenderDoc captures of frames, through the in-application interface.
 *
 * RenderDoc's library must be loaded before the program opens a device. This file does not load it.
 * RenderDoc loads it into programs that it starts. Its Vulkan layer also loads it if
 * ENABLE_VULKAN_RENDERDOC_CAPTURE=1 is set. Captures show the names of all passes and images.
 */
#ifndef FIRN_GPU_GPU_RENDERDOC_CAPTURE_H
#define FIRN_GPU_GPU_RENDERDOC_CAPTURE_H

#include "src/gpu/gpu.h"

/* Returns NULL if frames can be captured. Otherwise, returns a static text that says why not and
 * what to do. A device must be open. */
const char *gpu_capture_problem(void);

/* Begins to capture all submitted work, until gpu_capture_end(). */
void gpu_capture_begin(const struct gpu *gpu);

/* Ends the capture, writes its file and copies the file's path to `path`, which has `size` bytes.
 * If RenderDoc wrote no capture, logs an error and returns STATUS_WRITE. */
MUST_USE enum status gpu_capture_end(const struct gpu *gpu, char *path, size_t size);

#endif
