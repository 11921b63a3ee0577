/* gpu_limits.c: checks before any allocation whether an image is too large for a device. */
#include "src/base/log.h"
#include "src/base/machine.h"
#include "src/gpu/gpu.h"

enum {
    MIB = 1 << 20,
};

static uint32_t smaller(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

enum status gpu_check_size(const struct gpu *gpu, uint32_t width, uint32_t height)
{
    const VkPhysicalDeviceLimits *limits = &gpu->properties.limits;
    const uint32_t side = limits->maxImageDimension2D;
    const uint32_t width_max =
        smaller(side, smaller(limits->maxFramebufferWidth, limits->maxViewportDimensions[0]));
    const uint32_t height_max =
        smaller(side, smaller(limits->maxFramebufferHeight, limits->maxViewportDimensions[1]));
    if (width <= width_max && height <= height_max)
        return STATUS_OK;
    log_error("an image of %u x %u pixels: %s supports at most %u x %u; reduce --size, or use "
              "interleaved tiles (--tiles, --interleaved)",
              width, height, gpu->properties.deviceName, width_max, height_max);
    return STATUS_USAGE;
}

enum status gpu_check_texels(const struct gpu *gpu, const char *name, VkExtent3D size)
{
    const VkPhysicalDeviceLimits *limits = &gpu->properties.limits;
    const uint32_t side_max = limits->maxImageDimension2D;
    if (size.width > side_max || size.height > side_max)
        log_error("%s has %u x %u texels: %s supports at most %u x %u; use a smaller image", name,
                  size.width, size.height, gpu->properties.deviceName, side_max, side_max);
    else if (size.depth > limits->maxImageArrayLayers)
        log_error("%s has %u layers: %s supports at most %u; use fewer images", name, size.depth,
                  gpu->properties.deviceName, limits->maxImageArrayLayers);
    else
        return STATUS_OK;
    return STATUS_DATA;
}

/* Returns the index of the largest heap with memory of the given kind, or UINT32_MAX if none. */
static uint32_t find_heap(const VkPhysicalDeviceMemoryProperties *memory,
                          VkMemoryPropertyFlags kind)
{
    uint32_t found = UINT32_MAX;
    for (uint32_t i = 0; i < memory->memoryTypeCount; i++) {
        const uint32_t heap = memory->memoryTypes[i].heapIndex;
        if ((memory->memoryTypes[i].propertyFlags & kind) != kind)
            continue;
        if (found == UINT32_MAX || memory->memoryHeaps[heap].size > memory->memoryHeaps[found].size)
            found = heap;
    }
    return found;
}

/* Returns the usable size of a heap in bytes. For a CPU driver, it is at least three quarters of
 * the machine's memory, because CPU drivers may report too little. */
static VkDeviceSize heap_size(const struct gpu *gpu, uint32_t heap)
{
    const VkDeviceSize size = gpu->memory.memoryHeaps[heap].size;
    if (gpu->properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU)
        return size;
    const VkDeviceSize limit = machine_memory() / 4 * 3;
    return limit > size ? limit : size;
}

enum status gpu_check_memory(const struct gpu *gpu, VkExtent2D view, VkDeviceSize device_size,
                             VkDeviceSize host_size)
{
    const VkPhysicalDeviceMemoryProperties *memory = &gpu->memory;
    const uint32_t device = find_heap(memory, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    const uint32_t host = find_heap(memory, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
    for (uint32_t i = 0; i < memory->memoryHeapCount; i++) {
        const VkDeviceSize size = (i == device ? device_size : 0) + (i == host ? host_size : 0);
        const unsigned long long needed = size / MIB + (size % MIB != 0 ? 1 : 0);
        const unsigned long long given = heap_size(gpu, i) / MIB;
        if (size <= heap_size(gpu, i))
            continue;
        log_error("an image of %u x %u pixels needs %llu MiB of memory, %s has %llu MiB; reduce "
                  "--size or --aov, or use --tiles or --interleaved",
                  view.width, view.height, needed, gpu->properties.deviceName, given);
        return STATUS_TRY_AGAIN;
    }
    return STATUS_OK;
}

enum status gpu_check_acceleration_memory(const struct gpu *gpu, VkDeviceSize size)
{
    const uint32_t heap = find_heap(&gpu->memory, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (heap == UINT32_MAX || size <= heap_size(gpu, heap))
        return STATUS_OK;
    log_error("the scene's acceleration structures need %llu MiB of memory, %s has %llu MiB; use "
              "--set trace.traversal=tree",
              (unsigned long long)size / MIB + 1, gpu->properties.deviceName,
              (unsigned long long)heap_size(gpu, heap) / MIB);
    return STATUS_TRY_AGAIN;
}
