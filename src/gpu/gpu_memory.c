/* gpu_memory.c: allocates device memory, and creates buffers without content. */
#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

enum {
    MIB = 1 << 20,
};

uint32_t gpu_memory_type(const VkPhysicalDeviceMemoryProperties *memory, uint32_t bits,
                         VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred)
{
    uint32_t second = UINT32_MAX;
    for (uint32_t i = 0; i < memory->memoryTypeCount; i++) {
        const VkMemoryPropertyFlags flags = memory->memoryTypes[i].propertyFlags;
        if (!(bits >> i & 1) || (flags & required) != required)
            continue;
        if ((flags & preferred) == preferred)
            return i;
        if (second == UINT32_MAX)
            second = i;
    }
    return second;
}

static enum status too_large(const char *name, VkDeviceSize size, VkDeviceSize limit)
{
    const unsigned long long needed = size / MIB + (size % MIB != 0 ? 1 : 0);
    const unsigned long long given = limit / MIB;
    log_error("%s needs %llu MiB of memory, but the device's limit per allocation is %llu MiB",
              name ? name : "a buffer", needed, given);
    return STATUS_TRY_AGAIN;
}

enum status gpu_memory_allocate(struct gpu *gpu, const VkMemoryRequirements *needs,
                                enum gpu_memory_kind kind, const char *name, VkDeviceMemory *memory)
{
    const bool host = kind == GPU_MEMORY_HOST;
    VkPhysicalDeviceVulkan11Properties v11 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
    };
    VkPhysicalDeviceProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
        .pNext = &v11,
    };
    const uint32_t type = gpu_memory_type(
        &gpu->memory, needs->memoryTypeBits, host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT : 0,
        host ? VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type == UINT32_MAX) {
        log_error("%s: the device has no suitable memory type", name ? name : "a buffer");
        return STATUS_NO_DEVICE;
    }
    /* Limits are checked here, as some drivers accept too large allocations and crash later. */
    vkGetPhysicalDeviceProperties2(gpu->physical, &properties);
    VkDeviceSize limit = gpu->memory.memoryHeaps[gpu->memory.memoryTypes[type].heapIndex].size;
    if (limit > v11.maxMemoryAllocationSize)
        limit = v11.maxMemoryAllocationSize;
    if (needs->size > limit)
        return too_large(name, needs->size, limit);

    const VkMemoryAllocateFlagsInfo flags = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
        .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT,
    };
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .pNext = kind == GPU_MEMORY_ADDRESS ? &flags : NULL,
        .allocationSize = needs->size,
        .memoryTypeIndex = type,
    };
    const VkResult result = vkAllocateMemory(gpu->device, &info, NULL, memory);
    if (result == VK_SUCCESS)
        return STATUS_OK;
    *memory = VK_NULL_HANDLE;
    return gpu_failed_for("vkAllocateMemory", name, result);
}

enum status gpu_memory_buffer(struct gpu *gpu, struct gpu_buffer *buffer, VkBufferUsageFlags usage,
                              VkDeviceSize size, bool host, const char *name)
{
    VkPhysicalDeviceVulkan13Properties v13 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES,
    };
    VkPhysicalDeviceProperties2 properties = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
        .pNext = &v13,
    };
    VkMemoryRequirements needs;
    *buffer = (struct gpu_buffer){ 0 };
    vkGetPhysicalDeviceProperties2(gpu->physical, &properties);
    if (size > v13.maxBufferSize)
        return too_large(name, size, v13.maxBufferSize);

    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = usage,
    };
    VkResult result = vkCreateBuffer(gpu->device, &info, NULL, &buffer->buffer);
    if (result != VK_SUCCESS) {
        *buffer = (struct gpu_buffer){ 0 };
        return gpu_failed_for("vkCreateBuffer", name, result);
    }
    gpu_debug_name(gpu, VK_OBJECT_TYPE_BUFFER, (uint64_t)buffer->buffer, name);
    vkGetBufferMemoryRequirements(gpu->device, buffer->buffer, &needs);
    const bool has_address = usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const enum gpu_memory_kind kind = has_address ? GPU_MEMORY_ADDRESS
                                      : host      ? GPU_MEMORY_HOST
                                                  : GPU_MEMORY_DEVICE;
    enum status status = gpu_memory_allocate(gpu, &needs, kind, name, &buffer->memory);
    if (status == STATUS_OK) {
        result = vkBindBufferMemory(gpu->device, buffer->buffer, buffer->memory, 0);
        if (result != VK_SUCCESS)
            status = gpu_failed_for("vkBindBufferMemory", name, result);
    }
    if (status != STATUS_OK)
        gpu_buffer_destroy(gpu, buffer);
    buffer->size = status == STATUS_OK ? size : 0;
    return status;
}

void gpu_buffer_destroy(struct gpu *gpu, struct gpu_buffer *buffer)
{
    if (gpu->device) {
        vkDestroyBuffer(gpu->device, buffer->buffer, NULL);
        vkFreeMemory(gpu->device, buffer->memory, NULL);
    }
    *buffer = (struct gpu_buffer){ 0 };
}
