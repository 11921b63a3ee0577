/*
 * gpu_swapchain.h: swapchain: acquires and presents the images of a window.
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
 * A slot is a frame in flight; a caller reuses a slot only after its frame has finished.
 *
 * Ownership: the caller owns the surface, which must outlive the swapchain.
 * Errors:    logged once; as in gpu.h. A surface of zero size (a minimised window) is not an error:
 *            then there is no VkSwapchainKHR, and `stale` stays true.
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
    VkSwapchainKHR swapchain; /* VK_NULL_HANDLE without size */
    VkFormat format;
    bool encodes; /* colours are sRGB-encoded on writing */
    bool copies;  /* usable as transfer destinations */
    VkPresentModeKHR mode;
    VkExtent2D extent; /* pixels */
    VkImage *images;   /* undefined when acquired */
    uint32_t image_count;
    VkSemaphore acquired[GPU_SWAPCHAIN_SLOT_COUNT];
    VkSemaphore *drawn; /* one per image */
    bool stale;         /* must be recreated */
};

/* Chooses a format with 8 bits per channel, preferably without sRGB encoding. If `mode` is not
 * available, warns and uses FIFO. Creates no images, so sets `stale`. */
MUST_USE enum status gpu_swapchain_init(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                        VkSurfaceKHR surface, VkPresentModeKHR mode);

/* Waits for the device and recreates the images. Their size is set by the surface or, if the
 * surface leaves it open, is `size`, the window's size in pixels. */
MUST_USE enum status gpu_swapchain_recreate(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                            VkExtent2D size);

/* Acquires an image; *index is GPU_SWAPCHAIN_NONE if the swapchain has become stale. May block. */
MUST_USE enum status gpu_swapchain_acquire(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                           uint32_t slot, uint32_t *index);

/* Presents image `index` once the semaphore drawn[index] is signalled. */
MUST_USE enum status gpu_swapchain_present(struct gpu *gpu, struct gpu_swapchain *swapchain,
                                           uint32_t index);

/* Waits for the device and frees everything. *swapchain may be zeroed or partly created. */
void gpu_swapchain_finish(struct gpu *gpu, struct gpu_swapchain *swapchain);

/* Returns "fifo", "mailbox" or "immediate" for a present mode, or NULL for other modes. */
const char *gpu_swapchain_mode_name(VkPresentModeKHR mode);
/* Finds the present mode that gpu_swapchain_mode_name() calls `name`, or returns false. */
bool gpu_swapchain_mode_find(const char *name, VkPresentModeKHR *mode);

#endif
