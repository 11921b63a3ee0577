/* gpu_pipeline_cache.c: saves the Vulkan pipeline cache in a file, followed by a hash. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/disk_cache.h"
#include "src/gpu/gpu_internal.h"

enum {
    FILE_SIZE_MAX = 64 << 20,
    NAME_SIZE = 2 * VK_UUID_SIZE + 32,
};

bool gpu_pipeline_cache_is_valid(const VkPhysicalDeviceProperties *device, const void *data,
                                 size_t size)
{
    VkPipelineCacheHeaderVersionOne header;
    if (size < sizeof(header) + DISK_CACHE_HASH_SIZE)
        return false;
    memcpy(&header, data, sizeof(header));
    return header.headerSize == sizeof(header) &&
           header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == device->vendorID && header.deviceID == device->deviceID &&
           memcmp(header.pipelineCacheUUID, device->pipelineCacheUUID, VK_UUID_SIZE) == 0 &&
           disk_cache_is_intact(data, size);
}

static bool is_sound(const void *device, const void *data, size_t size)
{
    return gpu_pipeline_cache_is_valid(device, data, size);
}

static void write_name(const struct gpu *gpu, char name[static NAME_SIZE])
{
    int length = snprintf(name, NAME_SIZE, "pipelines-%04x-%04x-", gpu->properties.vendorID,
                          gpu->properties.deviceID);
    for (size_t i = 0; i < VK_UUID_SIZE; i++)
        length += snprintf(name + length, NAME_SIZE - (size_t)length, "%02x",
                           gpu->properties.pipelineCacheUUID[i]);
}

/* Returns the cache file's content and hash; NULL for a damaged file. The caller frees it. */
static void *read_file(const struct gpu *gpu, size_t *size)
{
    char name[NAME_SIZE];
    write_name(gpu, name);
    const struct disk_cache_file file = {
        .name = name, .size_max = FILE_SIZE_MAX, .is_sound = is_sound, .user = &gpu->properties
    };
    return disk_cache_read(&file, size);
}

enum status gpu_pipeline_cache_load(struct gpu *gpu)
{
    size_t size = 0;
    void *data = gpu->no_cache ? NULL : read_file(gpu, &size);
    VkPipelineCacheCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
        .initialDataSize = data ? size - DISK_CACHE_HASH_SIZE : 0,
        .pInitialData = data,
    };
    VkResult result = vkCreatePipelineCache(gpu->device, &info, NULL, &gpu->pipeline_cache);
    if (result != VK_SUCCESS && data) {
        info.initialDataSize = 0;
        result = vkCreatePipelineCache(gpu->device, &info, NULL, &gpu->pipeline_cache);
    }
    free(data);
    if (result == VK_SUCCESS)
        return STATUS_OK;
    gpu->pipeline_cache = VK_NULL_HANDLE;
    return gpu_failed("vkCreatePipelineCache", result);
}

/* Returns the driver's cache data, with space for its hash; the caller frees it. */
static char *get_data(const struct gpu *gpu, size_t *size)
{
    size_t used = 0;
    if (vkGetPipelineCacheData(gpu->device, gpu->pipeline_cache, &used, NULL) != VK_SUCCESS ||
        used == 0 || used > FILE_SIZE_MAX - DISK_CACHE_HASH_SIZE)
        return NULL;
    char *data = malloc(used + DISK_CACHE_HASH_SIZE);
    if (!data)
        return NULL;
    if (vkGetPipelineCacheData(gpu->device, gpu->pipeline_cache, &used, data) != VK_SUCCESS) {
        free(data);
        return NULL;
    }
    *size = used;
    return data;
}

void gpu_pipeline_cache_save(const struct gpu *gpu)
{
    char name[NAME_SIZE];
    size_t size = 0;
    char *data = get_data(gpu, &size);
    if (!data)
        return;
    write_name(gpu, name);
    disk_cache_write(name, data, size);
    free(data);
}
