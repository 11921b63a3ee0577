/* gpu_shared_window.c: window images in imported memory (VK_EXT_external_memory_host). */
#include "src/gpu/gpu_shared_window.h"
#include "src/gpu/gpu_internal.h"

static const VkExternalMemoryHandleTypeFlagBits host =
    VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;

static VkDeviceSize find_alignment(const struct gpu *gpu)
{
    VkPhysicalDeviceExternalMemoryHostPropertiesEXT imports = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_MEMORY_HOST_PROPERTIES_EXT,
    };
    VkPhysicalDeviceProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
        .pNext = &imports,
    };
    vkGetPhysicalDeviceProperties2(gpu->physical, &properties);
    return imports.minImportedHostPointerAlignment;
}

/* Returns true if the device supports an image of this description in imported host memory. */
static bool is_supported(const struct gpu *gpu, const VkImageCreateInfo *image)
{
    const VkPhysicalDeviceExternalImageFormatInfo external = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_EXTERNAL_IMAGE_FORMAT_INFO,
        .handleType = host,
    };
    const VkPhysicalDeviceImageFormatInfo2 info = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_FORMAT_INFO_2,
        .pNext = &external,
        .format = image->format,
        .type = image->imageType,
        .tiling = image->tiling,
        .usage = image->usage,
    };
    VkExternalImageFormatProperties imports = {
        .sType = VK_STRUCTURE_TYPE_EXTERNAL_IMAGE_FORMAT_PROPERTIES,
    };
    VkImageFormatProperties2 has = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_FORMAT_PROPERTIES_2,
        .pNext = &imports,
    };
    const VkExtent3D *limit = &has.imageFormatProperties.maxExtent;
    return vkGetPhysicalDeviceImageFormatProperties2(gpu->physical, &info, &has) == VK_SUCCESS &&
           imports.externalMemoryProperties.externalMemoryFeatures &
               VK_EXTERNAL_MEMORY_FEATURE_IMPORTABLE_BIT &&
           limit->width >= image->extent.width && limit->height >= image->extent.height;
}

/* Imports host memory as device memory. Returns false if `memory` is NULL or unsuitable. */
static bool import(const struct gpu *gpu, const VkMemoryRequirements *needs, VkDeviceSize size,
                   void *memory, VkDeviceMemory *imported)
{
    VkMemoryHostPointerPropertiesEXT can = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_HOST_POINTER_PROPERTIES_EXT,
    };
    if (!memory ||
        vkGetMemoryHostPointerPropertiesEXT(gpu->device, host, memory, &can) != VK_SUCCESS)
        return false;
    const VkImportMemoryHostPointerInfoEXT source = {
        .sType = VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT,
        .handleType = host,
        .pHostPointer = memory,
    };
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .pNext = &source,
        .allocationSize = size,
        .memoryTypeIndex = gpu_memory_type(
            &gpu->memory, needs->memoryTypeBits & can.memoryTypeBits,
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, 0),
    };
    return info.memoryTypeIndex != UINT32_MAX &&
           vkAllocateMemory(gpu->device, &info, NULL, imported) == VK_SUCCESS;
}

static bool create_image(const struct gpu *gpu, const struct gpu_shared_window *canvas,
                         VkExtent2D extent, uint32_t index, struct gpu_shared_window_image *created)
{
    const VkExternalMemoryImageCreateInfo external = {
        .sType = VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_IMAGE_CREATE_INFO,
        .handleTypes = host,
    };
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .pNext = &external,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = VK_FORMAT_B8G8R8A8_UNORM,
        .extent = { extent.width, extent.height, 1 },
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .tiling = VK_IMAGE_TILING_LINEAR,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
    };
    const VkImageSubresource all = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0 };
    const VkDeviceSize alignment = find_alignment(gpu);
    VkMemoryRequirements needs;
    VkSubresourceLayout rows;
    if (!is_supported(gpu, &info) ||
        vkCreateImage(gpu->device, &info, NULL, &created->image) != VK_SUCCESS)
        return false;
    gpu_debug_name(gpu, VK_OBJECT_TYPE_IMAGE, (uint64_t)created->image, "window");
    vkGetImageMemoryRequirements(gpu->device, created->image, &needs);
    vkGetImageSubresourceLayout(gpu->device, created->image, &all, &rows);
    created->row_size = (uint32_t)rows.rowPitch;
    const VkDeviceSize size = (needs.size + alignment - 1) / alignment * alignment;
    void *memory = canvas->map(canvas->user, index, (size_t)size);
    return rows.offset == 0 && (uintptr_t)memory % alignment == 0 &&
           import(gpu, &needs, size, memory, &created->memory) &&
           vkBindImageMemory(gpu->device, created->image, created->memory, 0) == VK_SUCCESS;
}

bool gpu_shared_window_create_images(
    const struct gpu *gpu, const struct gpu_shared_window *canvas, VkExtent2D extent,
    struct gpu_shared_window_image images[GPU_SHARED_WINDOW_IMAGE_COUNT])
{
    bool is_made = true;
    for (uint32_t i = 0; i < GPU_SHARED_WINDOW_IMAGE_COUNT && is_made; i++)
        is_made = create_image(gpu, canvas, extent, i, &images[i]);
    if (!is_made)
        gpu_shared_window_destroy_images(gpu, canvas, images);
    return is_made;
}

void gpu_shared_window_destroy_images(
    const struct gpu *gpu, const struct gpu_shared_window *canvas,
    struct gpu_shared_window_image images[GPU_SHARED_WINDOW_IMAGE_COUNT])
{
    for (uint32_t i = 0; i < GPU_SHARED_WINDOW_IMAGE_COUNT; i++) {
        if (!images[i].image)
            continue;
        vkDestroyImage(gpu->device, images[i].image, NULL);
        vkFreeMemory(gpu->device, images[i].memory, NULL);
        canvas->unmap(canvas->user, i);
        images[i] = (struct gpu_shared_window_image){ 0 };
    }
}
