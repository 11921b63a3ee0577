/*
 * gpu_renderdoc_capture.h: captures of frames for RenderDoc, through its in-application interface.
 *
 * RenderDoc's library must be loaded before the program opens a device. RenderDoc loads it into
 * programs that it starts, and its Vulkan layer loads it with ENABLE_VULKAN_RENDERDOC_CAPTURE=1.
 * This file does not load it. Captures show every pass and image by its name.
 */
#ifndef FIRN_GPU_GPU_RENDERDOC_CAPTURE_H
#define FIRN_GPU_GPU_RENDERDOC_CAPTURE_H

#include "src/gpu/gpu.h"

/* Returns a static text that says why frames cannot be captured and what to do, or NULL if frames
 * can be captured. A device must be open. */
const char *gpu_capture_problem(void);

/* Begins to capture all submitted work, until gpu_capture_end(). */
void gpu_capture_begin(const struct gpu *gpu);

/* Ends the capture, writes its file and copies the file's path to `path` (`size` bytes). If there
 * is no capture, logs an error and returns STATUS_WRITE. */
MUST_USE enum status gpu_capture_end(const struct gpu *gpu, char *path, size_t size);

#endif
