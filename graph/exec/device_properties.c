/* device_properties.c: answers the compiler's queries about a device (struct rg_device). */
#include "graph/rg_exec.h"

#define FIND(vulkan, name) ((PFN_##name)(vulkan)->get_proc_addr((vulkan)->instance, #name))

static struct rg_memory_requirements requirements_of(const VkMemoryRequirements2 *r)
{
    return (struct rg_memory_requirements){
        .size = r->memoryRequirements.size,
        .alignment = r->memoryRequirements.alignment,
        .type_bits = r->memoryRequirements.memoryTypeBits,
    };
}

static struct rg_memory_requirements image_memory(const void *user, const VkImageCreateInfo *info)
{
    const struct rg_vulkan *vulkan = user;
    const PFN_vkGetDeviceImageMemoryRequirements query =
        FIND(vulkan, vkGetDeviceImageMemoryRequirements);
    VkMemoryRequirements2 requirements = { .sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2 };
    query(vulkan->device,
          &(VkDeviceImageMemoryRequirements){
              .sType = VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS,
              .pCreateInfo = info,
          },
          &requirements);
    return requirements_of(&requirements);
}

static struct rg_memory_requirements buffer_memory(const void *user, const VkBufferCreateInfo *info)
{
    const struct rg_vulkan *vulkan = user;
    const PFN_vkGetDeviceBufferMemoryRequirements query =
        FIND(vulkan, vkGetDeviceBufferMemoryRequirements);
    VkMemoryRequirements2 requirements = { .sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2 };
    query(vulkan->device,
          &(VkDeviceBufferMemoryRequirements){
              .sType = VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS,
              .pCreateInfo = info,
          },
          &requirements);
    return requirements_of(&requirements);
}

static VkFormatFeatureFlags format_features(const void *user, VkFormat format)
{
    const struct rg_vulkan *vulkan = user;
    VkFormatProperties properties;
    FIND(vulkan, vkGetPhysicalDeviceFormatProperties)(vulkan->physical, format, &properties);
    return properties.optimalTilingFeatures;
}

static VkFormatFeatureFlags buffer_features(const void *user, VkFormat format)
{
    const struct rg_vulkan *vulkan = user;
    VkFormatProperties properties;
    FIND(vulkan, vkGetPhysicalDeviceFormatProperties)(vulkan->physical, format, &properties);
    return properties.bufferFeatures;
}

static VkSampleCountFlags sample_counts(const void *user, const VkImageCreateInfo *info)
{
    const struct rg_vulkan *vulkan = user;
    const PFN_vkGetPhysicalDeviceImageFormatProperties query =
        FIND(vulkan, vkGetPhysicalDeviceImageFormatProperties);
    VkImageFormatProperties properties;
    VkResult result = query(vulkan->physical, info->format, info->imageType, info->tiling,
                            info->usage, info->flags, &properties);
    return result == VK_SUCCESS ? properties.sampleCounts : 0;
}

struct rg_device rg_exec_device(const struct rg_vulkan *vulkan)
{
    VkPhysicalDeviceProperties properties;
    if (!vulkan->instance || !vulkan->get_proc_addr || !vulkan->physical || !vulkan->device)
        return (struct rg_device){ 0 };
    FIND(vulkan, vkGetPhysicalDeviceProperties)(vulkan->physical, &properties);
    return (struct rg_device){
        .user = vulkan,
        .image_memory = image_memory,
        .buffer_memory = buffer_memory,
        .format_features = format_features,
        .buffer_features = buffer_features,
        .sample_counts = sample_counts,
        .max_image_size = properties.limits.maxImageDimension2D,
        .max_layers = properties.limits.maxImageArrayLayers,
        .max_volume_size = properties.limits.maxImageDimension3D,
    };
}
