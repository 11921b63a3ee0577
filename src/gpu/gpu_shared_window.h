/*
 * gpu_shared_window.h: window images in memory that is shared with the window server.
 *
 * Where window server and driver share no memory, a CPU driver copies each frame and sends it
 * through a socket: Mesa 22.3 does so on X servers without DRI3 (Xvfb, VNC). With shared memory,
 * frames are rendered and read in place, without a copy.
 *
 * Ownership: the window owns the canvas (struct gpu_shared_window), which outlives the images; each
 * image owns its memory import.
 */
#ifndef FIRN_GPU_GPU_SHARED_WINDOW_H
#define FIRN_GPU_GPU_SHARED_WINDOW_H

#include "src/gpu/gpu.h"

enum {
    GPU_SHARED_WINDOW_IMAGE_COUNT = 2, /* double buffering */
};

/* Callbacks by which a window provides shared memory and presents images in it. */
struct gpu_shared_window {
    void *user;
    /* Returns `size` bytes that the window server can read, or NULL. unmap() frees the bytes. */
    void *(*map)(void *user, uint32_t index, size_t size);
    void (*unmap)(void *user, uint32_t index);
    /* Presents an image of 4-byte BGRA pixels in rows of `row_size` bytes, without waiting. */
    void (*show)(void *user, uint32_t index, VkExtent2D extent, uint32_t row_size);
    void (*wait)(void *user, uint32_t index); /* waits until the server has read the image */
};

/* An image in memory shared with the window server. */
struct gpu_shared_window_image {
    VkImage image;
    VkDeviceMemory memory;
    uint32_t row_size; /* bytes */
};

/* Creates BGRA images in shared memory, for use as colour attachments and transfer destinations. If
 * the memory or the device is unsuitable, returns false without logging and creates nothing. */
MUST_USE bool gpu_shared_window_create_images(
    const struct gpu *gpu, const struct gpu_shared_window *canvas, VkExtent2D extent,
    struct gpu_shared_window_image images[GPU_SHARED_WINDOW_IMAGE_COUNT]);

/* Destroys a window's shared images, which may be zeroed or partly created. The device must be
 * idle. */
void gpu_shared_window_destroy_images(
    const struct gpu *gpu, const struct gpu_shared_window *canvas,
    struct gpu_shared_window_image images[GPU_SHARED_WINDOW_IMAGE_COUNT]);

#endif
