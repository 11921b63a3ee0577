/*
 * gpu_canvas.h: images of a window in memory that the window's server reads.
 *
 * Where a window's server and a driver share no memory, a driver on a CPU copies each picture, and
 * sends it through a socket: Mesa 22.3 does, under X servers without DRI3 (Xvfb, VNC). In memory
 * that the server reads itself, pictures are drawn and read where they are.
 *
 * Ownership: a canvas is its window's and outlives the images, which own their memory's use.
 */
#ifndef FIRN_GPU_GPU_CANVAS_H
#define FIRN_GPU_GPU_CANVAS_H

#include "src/gpu/gpu.h"

enum {
    GPU_CANVAS_COUNT = 2, /* images: one is drawn while the server reads the other */
};

/* What a window gives. */
struct gpu_canvas {
    void *user;
    /* Makes memory of so many bytes that the server can read, until unmap(); NULL: none. */
    void *(*map)(void *user, uint32_t index, size_t size);
    void (*unmap)(void *user, uint32_t index);
    /* Shows rows of so many bytes, blue first, four bytes a pixel. Does not wait until wait(). */
    void (*show)(void *user, uint32_t index, VkExtent2D extent, uint32_t row_size);
    void (*wait)(void *user, uint32_t index); /* until the server has read what it was shown */
};

/* An image in such memory. */
struct gpu_canvas_image {
    VkImage image;
    VkDeviceMemory memory;
    uint32_t row_size; /* bytes */
};

/* Makes a canvas's images, blue first, colour targets that can be copied into. False, silently:
 * memory or device do not allow it, and nothing is kept. */
MUST_USE bool gpu_canvas_make(const struct gpu *gpu, const struct gpu_canvas *canvas,
                              VkExtent2D extent, struct gpu_canvas_image images[GPU_CANVAS_COUNT]);

/* {0} and half-built are fine. The device must be idle. */
void gpu_canvas_free(const struct gpu *gpu, const struct gpu_canvas *canvas,
                     struct gpu_canvas_image images[GPU_CANVAS_COUNT]);

#endif
