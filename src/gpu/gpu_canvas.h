/*
 * gpu_canvas.h: window images in memory that is shared with the window server.
 *
 * Where window server and driver share no memory, a CPU driver copies each frame and sends it
 * through a socket: Mesa 22.3 does so on X servers without DRI3 (Xvfb, VNC). With shared memory,
 * frames are rendered and read in place, without a copy.
 *
 * Ownership: the window owns the canvas, which outlives the images; these own their memory import.
 */
#ifndef FIRN_GPU_GPU_CANVAS_H
#define FIRN_GPU_GPU_CANVAS_H

#include "src/gpu/gpu.h"

enum {
    GPU_CANVAS_COUNT = 2, /* double buffering: one is drawn while the server reads the other */
};

/* Callbacks by which a window provides shared memory and presents images in it. */
struct gpu_canvas {
    void *user;
    /* Allocates `size` bytes that the server can read, until unmap(); returns NULL on failure. */
    void *(*map)(void *user, uint32_t index, size_t size);
    void (*unmap)(void *user, uint32_t index);
    /* Presents rows of `row_size` bytes, BGRA, four bytes per pixel. Does not wait; see wait(). */
    void (*show)(void *user, uint32_t index, VkExtent2D extent, uint32_t row_size);
    void (*wait)(void *user, uint32_t index); /* waits until the server has read the image */
};

/* An image in memory shared with the window server. */
struct gpu_canvas_image {
    VkImage image;
    VkDeviceMemory memory;
    uint32_t row_size; /* bytes */
};

/* Creates a canvas's images, BGRA, usable as colour attachments and transfer destinations. Returns
 * false, without logging, if memory or device do not allow it; then nothing is created. */
MUST_USE bool gpu_canvas_make(const struct gpu *gpu, const struct gpu_canvas *canvas,
                              VkExtent2D extent, struct gpu_canvas_image images[GPU_CANVAS_COUNT]);

/* Destroys a canvas's images; {0} and half-built are fine. The device must be idle. */
void gpu_canvas_free(const struct gpu *gpu, const struct gpu_canvas *canvas,
                     struct gpu_canvas_image images[GPU_CANVAS_COUNT]);

#endif
