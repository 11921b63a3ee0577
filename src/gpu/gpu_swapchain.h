/*
 * gpu_swapchain.h: the images of a window, one after another.
 *
 *     while (...) {
 *         if (swapchain.stale)                       resized, moved to another screen, ...
 *             gpu_swapchain_recreate(gpu, &swapchain, size);
 *         gpu_swapchain_acquire(gpu, &swapchain, slot, &index);
 *         if (index == GPU_SWAPCHAIN_NONE)
 *             continue;                              it has just become stale
 *         ... draw to images[index]: waits for acquired[slot], signals drawn[index] ...
 *         gpu_swapchain_present(gpu, &swapchain, index);
 *     }
 *
 * A slot is a frame in flight; a caller comes back to one only after its frame is done.
 *
 * Ownership: the surface is the caller's and outlives the swapchain.
 * Errors:    logged once; as of gpu.h. A surface of no size (a minimised window) is none: then
 *            there is no swapchain, and it stays stale.
 */
#ifndef FIRN_GPU_SWAPCHAIN_H
#define FIRN_GPU_SWAPCHAIN_H

#include "src/gpu/gpu.h"

enum {
    GPU_SWAPCHAIN_SLOT_COUNT = 2, /* frames in flight */
};

#define GPU_SWAPCHAIN_NONE UINT32_MAX /* no image */

struct gpu_swapchain {
    VkSurfaceKHR surface;
    VkSwapchainKHR swapchain; /* VK_NULL_HANDLE while the surface has no size */
    VkFormat format;
    bool encodes; /* the format makes sRGB of linear colours that are written to it */
    VkPresentModeKHR mode;
    VkExtent2D extent; /* pixels */
    VkImage *images;   /* to draw to; content undefined when acquired */
    uint32_t image_count;
    VkSemaphore acquired[GPU_SWAPCHAIN_SLOT_COUNT];
    VkSemaphore *drawn; /* one an image */
    bool stale;         /* no longer fits the surface */
};

/*
 * Chooses a format, eight bits a channel and, if there is one, without encoding; and a present
 * mode: `mode`, or with a warning FIFO, which is always there. Makes no images yet: it is stale.
 */
MUST_USE enum status gpu_swapchain_init(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                        VkSurfaceKHR surface, VkPresentModeKHR mode);

/* Waits for the device and makes the images anew; `size`, in pixels, is that of the window, for
 * surfaces that leave it to the program. */
MUST_USE enum status gpu_swapchain_recreate(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                            VkExtent2D size);

/* *index is GPU_SWAPCHAIN_NONE if it became stale instead. May wait for the screen. */
MUST_USE enum status gpu_swapchain_acquire(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                           uint32_t slot, uint32_t *index);

/* Shows the image when drawn[index] is signalled. */
MUST_USE enum status gpu_swapchain_present(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                           uint32_t index);

/* Waits for the device. A {0} or half-built one is fine. */
void gpu_swapchain_finish(struct gpu *gpu, struct gpu_swapchain *swapchain);

/* "fifo", "mailbox", "immediate"; NULL: another one. */
const char *gpu_swapchain_mode_name(VkPresentModeKHR mode);
bool gpu_swapchain_mode_find(const char *name, VkPresentModeKHR *mode);

#endif
