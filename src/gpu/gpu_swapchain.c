/* gpu_swapchain.c: creates, acquires, presents and recreates the images of a window. */
#include "src/gpu/gpu_swapchain.h"

#include <stdlib.h>
#include <string.h>

#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

/* Surface formats, best first. Images are sRGB-encoded already, so the format need not encode. */
static const struct {
    VkFormat format;
    bool encodes;
} formats[] = {
    { VK_FORMAT_B8G8R8A8_UNORM, false },        { VK_FORMAT_R8G8B8A8_UNORM, false },
    { VK_FORMAT_A8B8G8R8_UNORM_PACK32, false }, { VK_FORMAT_B8G8R8A8_SRGB, true },
    { VK_FORMAT_R8G8B8A8_SRGB, true },          { VK_FORMAT_A8B8G8R8_SRGB_PACK32, true },
};

static const struct {
    VkPresentModeKHR mode;
    const char *name;
} modes[] = {
    { VK_PRESENT_MODE_FIFO_KHR, "fifo" },
    { VK_PRESENT_MODE_MAILBOX_KHR, "mailbox" },
    { VK_PRESENT_MODE_IMMEDIATE_KHR, "immediate" },
};

enum {
    FORMAT_COUNT = sizeof(formats) / sizeof(formats[0]),
    MODE_COUNT = sizeof(modes) / sizeof(modes[0]),
    OFFER_MAX = 128, /* maximum number of formats or modes */
};

const char *gpu_swapchain_mode_name(VkPresentModeKHR mode)
{
    for (size_t i = 0; i < MODE_COUNT; i++) {
        if (modes[i].mode == mode)
            return modes[i].name;
    }
    return NULL;
}

bool gpu_swapchain_mode_find(const char *name, VkPresentModeKHR *mode)
{
    for (size_t i = 0; i < MODE_COUNT; i++) {
        if (strcmp(modes[i].name, name) == 0) {
            *mode = modes[i].mode;
            return true;
        }
    }
    return false;
}

static enum status choose_format(const struct gpu *gpu, struct gpu_swapchain *s)
{
    VkSurfaceFormatKHR available[OFFER_MAX];
    uint32_t count = OFFER_MAX;
    const VkResult result =
        vkGetPhysicalDeviceSurfaceFormatsKHR(gpu->physical, s->surface, &count, available);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE)
        return gpu_failed("vkGetPhysicalDeviceSurfaceFormatsKHR", result);
    for (size_t f = 0; f < FORMAT_COUNT; f++) {
        for (uint32_t i = 0; i < count; i++) {
            if (available[i].format != formats[f].format ||
                available[i].colorSpace != VK_COLOR_SPACE_SRGB_NONLINEAR_KHR)
                continue;
            s->format = formats[f].format;
            s->encodes = formats[f].encodes;
            return STATUS_OK;
        }
    }
    log_error("the window supports no pixel format with 8 bits per channel (%u other formats)",
              count);
    return STATUS_NO_DEVICE;
}

static enum status choose_mode(const struct gpu *gpu, struct gpu_swapchain *s,
                               VkPresentModeKHR requested)
{
    VkPresentModeKHR available[OFFER_MAX];
    uint32_t count = OFFER_MAX;
    const VkResult result =
        vkGetPhysicalDeviceSurfacePresentModesKHR(gpu->physical, s->surface, &count, available);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE)
        return gpu_failed("vkGetPhysicalDeviceSurfacePresentModesKHR", result);
    s->mode = VK_PRESENT_MODE_FIFO_KHR;
    for (uint32_t i = 0; i < count; i++) {
        if (available[i] == requested)
            s->mode = requested;
    }
    if (s->mode != requested)
        log_warning("--present %s: this window does not support the mode; using fifo",
                    gpu_swapchain_mode_name(requested));
    return STATUS_OK;
}

static enum status find_usage(const struct gpu *gpu, struct gpu_swapchain *s)
{
    VkSurfaceCapabilitiesKHR has;
    const VkResult result =
        vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu->physical, s->surface, &has);
    if (result != VK_SUCCESS)
        return gpu_failed("vkGetPhysicalDeviceSurfaceCapabilitiesKHR", result);
    s->copies = has.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    return STATUS_OK;
}

static VkSemaphore make_semaphore(const struct gpu *gpu, VkResult *result)
{
    VkSemaphore semaphore = VK_NULL_HANDLE;
    const VkSemaphoreCreateInfo info = { .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO };
    if (*result == VK_SUCCESS)
        *result = vkCreateSemaphore(gpu->device, &info, NULL, &semaphore);
    return *result == VK_SUCCESS ? semaphore : VK_NULL_HANDLE;
}

enum status gpu_swapchain_init(struct gpu *gpu, struct gpu_swapchain *s, VkSurfaceKHR surface,
                               VkPresentModeKHR mode)
{
    *s = (struct gpu_swapchain){ .surface = surface, .stale = true };
    enum status status = choose_format(gpu, s);
    if (status == STATUS_OK)
        status = choose_mode(gpu, s, mode);
    if (status == STATUS_OK)
        status = find_usage(gpu, s);
    return status;
}

static void free_images(const struct gpu *gpu, struct gpu_swapchain *s)
{
    for (uint32_t i = 0; s->drawn && i < s->image_count; i++)
        vkDestroySemaphore(gpu->device, s->drawn[i], NULL);
    for (uint32_t i = 0; i < GPU_SWAPCHAIN_SLOT_COUNT; i++) {
        vkDestroySemaphore(gpu->device, s->acquired[i], NULL);
        s->acquired[i] = VK_NULL_HANDLE;
    }
    free(s->drawn);
    free(s->images);
    s->drawn = NULL;
    s->images = NULL;
    s->image_count = 0;
}

static enum status find_images(struct gpu *gpu, struct gpu_swapchain *s)
{
    uint32_t count = 0;
    VkResult result = vkGetSwapchainImagesKHR(gpu->device, s->swapchain, &count, NULL);
    if (result != VK_SUCCESS)
        return gpu_failed("vkGetSwapchainImagesKHR", result);
    s->images = calloc(count, sizeof(*s->images));
    s->drawn = calloc(count, sizeof(*s->drawn));
    if (!s->images || !s->drawn)
        return gpu_failed("calloc", VK_ERROR_OUT_OF_HOST_MEMORY);
    s->image_count = count;
    for (uint32_t i = 0; i < GPU_SWAPCHAIN_SLOT_COUNT; i++)
        s->acquired[i] = make_semaphore(gpu, &result);
    if (result != VK_SUCCESS)
        return gpu_failed("vkCreateSemaphore", result);
    result = vkGetSwapchainImagesKHR(gpu->device, s->swapchain, &count, s->images);
    if (result != VK_SUCCESS)
        return gpu_failed("vkGetSwapchainImagesKHR", result);
    for (uint32_t i = 0; i < count; i++) {
        gpu_debug_name(gpu, VK_OBJECT_TYPE_IMAGE, (uint64_t)s->images[i], "window");
        s->drawn[i] = make_semaphore(gpu, &result);
    }
    return result == VK_SUCCESS ? STATUS_OK : gpu_failed("vkCreateSemaphore", result);
}

static uint32_t clamp(uint32_t value, uint32_t min, uint32_t max)
{
    return value < min ? min : value > max ? max : value;
}

/* Returns the surface's size, or the window's `size` if the surface lets the program choose. */
static VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR *has, VkExtent2D size)
{
    if (has->currentExtent.width != UINT32_MAX)
        return has->currentExtent;
    if (size.width == 0 || size.height == 0)
        return (VkExtent2D){ 0, 0 };
    return (VkExtent2D){
        clamp(size.width, has->minImageExtent.width, has->maxImageExtent.width),
        clamp(size.height, has->minImageExtent.height, has->maxImageExtent.height),
    };
}

/* Returns the minimum image count plus one, so that an image is free while another is displayed. */
static uint32_t choose_count(const VkSurfaceCapabilitiesKHR *has)
{
    const uint32_t count = has->minImageCount + 1;
    return has->maxImageCount && count > has->maxImageCount ? has->maxImageCount : count;
}

static VkCompositeAlphaFlagBitsKHR choose_alpha(const VkSurfaceCapabilitiesKHR *has)
{
    const VkCompositeAlphaFlagsKHR all = has->supportedCompositeAlpha;
    return all & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                   : (VkCompositeAlphaFlagBitsKHR)(all & -all);
}

static enum status create(struct gpu *gpu, struct gpu_swapchain *s,
                          const VkSurfaceCapabilitiesKHR *has)
{
    VkSwapchainKHR before = s->swapchain;
    const VkSwapchainCreateInfoKHR info = {
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = s->surface,
        .minImageCount = choose_count(has),
        .imageFormat = s->format,
        .imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR,
        .imageExtent = s->extent,
        .imageArrayLayers = 1,
        .imageUsage =
            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | (s->copies ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : 0),
        .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .preTransform = has->currentTransform,
        .compositeAlpha = choose_alpha(has),
        .presentMode = s->mode,
        .clipped = VK_TRUE,
        .oldSwapchain = before,
    };
    s->swapchain = VK_NULL_HANDLE;
    const VkResult result = vkCreateSwapchainKHR(gpu->device, &info, NULL, &s->swapchain);
    vkDestroySwapchainKHR(gpu->device, before, NULL);
    if (result != VK_SUCCESS) {
        s->swapchain = VK_NULL_HANDLE;
        return gpu_failed("vkCreateSwapchainKHR", result);
    }
    return find_images(gpu, s);
}

enum status gpu_swapchain_recreate(struct gpu *gpu, struct gpu_swapchain *s, VkExtent2D size)
{
    VkSurfaceCapabilitiesKHR has;
    VkResult result = vkDeviceWaitIdle(gpu->device);
    if (result != VK_SUCCESS)
        return gpu_failed("vkDeviceWaitIdle", result);
    free_images(gpu, s);
    result = vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu->physical, s->surface, &has);
    if (result != VK_SUCCESS)
        return gpu_failed("vkGetPhysicalDeviceSurfaceCapabilitiesKHR", result);
    s->extent = choose_extent(&has, size);
    s->stale = s->extent.width == 0 || s->extent.height == 0;
    if (!s->stale)
        return create(gpu, s, &has);
    vkDestroySwapchainKHR(gpu->device, s->swapchain, NULL);
    s->swapchain = VK_NULL_HANDLE;
    return STATUS_OK;
}

void gpu_swapchain_finish(struct gpu *gpu, struct gpu_swapchain *s)
{
    if (!gpu->device)
        return;
    (void)vkDeviceWaitIdle(gpu->device); /* the swapchain is destroyed even if the device is lost */
    free_images(gpu, s);
    if (s->swapchain)
        vkDestroySwapchainKHR(gpu->device, s->swapchain, NULL);
    *s = (struct gpu_swapchain){ 0 };
}

enum status gpu_swapchain_acquire(struct gpu *gpu, struct gpu_swapchain *s, uint32_t slot,
                                  uint32_t *index)
{
    const VkResult result = vkAcquireNextImageKHR(gpu->device, s->swapchain, UINT64_MAX,
                                                  s->acquired[slot], VK_NULL_HANDLE, index);
    if (result == VK_SUCCESS)
        return STATUS_OK;
    s->stale = true;
    if (result == VK_SUBOPTIMAL_KHR)
        return STATUS_OK;
    *index = GPU_SWAPCHAIN_NONE;
    return result == VK_ERROR_OUT_OF_DATE_KHR ? STATUS_OK
                                              : gpu_failed("vkAcquireNextImageKHR", result);
}

enum status gpu_swapchain_present(struct gpu *gpu, struct gpu_swapchain *s, uint32_t index)
{
    const VkPresentInfoKHR info = {
        .sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
        .waitSemaphoreCount = 1,
        .pWaitSemaphores = &s->drawn[index],
        .swapchainCount = 1,
        .pSwapchains = &s->swapchain,
        .pImageIndices = &index,
    };
    const VkResult result = vkQueuePresentKHR(gpu->queue, &info);
    if (result == VK_SUCCESS)
        return STATUS_OK;
    s->stale = true;
    return result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR
               ? STATUS_OK
               : gpu_failed("vkQueuePresentKHR", result);
}
