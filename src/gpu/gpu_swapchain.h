/*
 * gpu_swapchain.h: a swapchain, which presents images in a window.
 *
 *     while (...) {
 *         if (swapchain.stale)                       resized, moved to another screen, ...
 *             gpu_swapchain_recreate(gpu, &swapchain, size);
 *         gpu_swapchain_acquire(gpu, &swapchain, slot, &index);
 *         if (index == GPU_SWAPCHAIN_NONE)
 *             continue;                              the swapchain has become stale
 *         ... draw to images[index]: waits for acquired[slot], signals drawn[index] ...
 *         gpu_swapchain_present(gpu, &swapchain, index);
 *     }
 *
 * A slot is a frame in flight; a caller uses a slot again only when its frame is done.
 *
 * With a canvas the images are its, not the driver's; there are no semaphores then, and presenting
 * waits for the queue.
 *
 * Ownership: surface and canvas are the caller's and outlive the swapchain.
 * Errors:    logged once; as of gpu.h. A surface of zero size (a minimised window) is no error:
 *            then there is no VkSwapchainKHR, and `stale` stays true.
 */
#ifndef FIRN_GPU_SWAPCHAIN_H
#define FIRN_GPU_SWAPCHAIN_H

#include "src/gpu/gpu.h"
#include "src/gpu/gpu_canvas.h"

enum {
    GPU_SWAPCHAIN_SLOT_COUNT = 2, /* frames in flight */
};

#define GPU_SWAPCHAIN_NONE UINT32_MAX /* no image */

/* As a present mode: a canvas if that is possible, else FIFO. */
#define GPU_SWAPCHAIN_ANY VK_PRESENT_MODE_MAX_ENUM_KHR

struct gpu_swapchain {
    VkSurfaceKHR surface;
    VkSwapchainKHR swapchain;        /* VK_NULL_HANDLE while the surface has no size, and with: */
    const struct gpu_canvas *canvas; /* NULL: the images are the driver's */
    struct gpu_canvas_image canvas_images[GPU_CANVAS_COUNT];
    uint32_t shown; /* of these */
    VkFormat format;
    bool encodes; /* the format encodes linear colours that are written to it as sRGB */
    bool copies;  /* images can be copied into its images */
    VkPresentModeKHR mode;
    VkExtent2D extent; /* pixels */
    VkImage *images;   /* render targets; content undefined when acquired */
    uint32_t image_count;
    VkSemaphore acquired[GPU_SWAPCHAIN_SLOT_COUNT];
    VkSemaphore *drawn; /* one per image */
    bool stale;         /* no longer fits the surface */
};

/*
 * Chooses a format with eight bits a channel, without sRGB encoding if possible, and a present
 * mode: `mode` or, with a warning, FIFO, which every surface supports. Creates no images: `stale`
 * is true. The canvas may be NULL.
 */
MUST_USE enum status gpu_swapchain_init(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                        VkSurfaceKHR surface, VkPresentModeKHR mode,
                                        const struct gpu_canvas *canvas);

/* Waits for the device and recreates the images. `size`, in pixels, is the window's size, which
 * counts for surfaces that let the program choose. */
MUST_USE enum status gpu_swapchain_recreate(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                            VkExtent2D size);

/* Acquires an image, or sets *index to GPU_SWAPCHAIN_NONE if the swapchain has become stale. May
 * wait for the screen. */
MUST_USE enum status gpu_swapchain_acquire(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                           uint32_t slot, uint32_t *index);

/* Presents the image when drawn[index] is signalled. */
MUST_USE enum status gpu_swapchain_present(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                           uint32_t index);

/* Waits for the device and frees everything. A {0} or half-built swapchain is fine. */
void gpu_swapchain_finish(struct gpu *gpu, struct gpu_swapchain *swapchain);

/* The name of a mode, "auto", "fifo", "mailbox" or "immediate", or NULL; and the mode of a name,
 * which returns false if there is none. */
const char *gpu_swapchain_mode_name(VkPresentModeKHR mode);
bool gpu_swapchain_mode_find(const char *name, VkPresentModeKHR *mode);

#endif
