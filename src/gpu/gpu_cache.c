/* gpu_cache.c: saves the pipeline cache in a file between runs: the driver's data and a hash. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "src/base/log.h"
#include "src/gpu/gpu_internal.h"

enum {
    FILE_SIZE_MAX = 64 << 20,
    HASH_SIZE = sizeof(uint64_t),
};

/* FNV-1a, 64 bits. The hash is checked because a driver may crash on damaged data. */
static uint64_t hash(const unsigned char *data, size_t size)
{
    uint64_t value = 0xcbf29ce484222325;
    for (size_t i = 0; i < size; i++)
        value = (value ^ data[i]) * 0x100000001b3;
    return value;
}

bool gpu_cache_sound(const VkPhysicalDeviceProperties *device, const void *data, size_t size)
{
    VkPipelineCacheHeaderVersionOne header;
    uint64_t stored = 0;
    if (size < sizeof(header) + HASH_SIZE)
        return false;
    size -= HASH_SIZE;
    memcpy(&stored, (const char *)data + size, HASH_SIZE);
    memcpy(&header, data, sizeof(header));
    return header.headerSize == sizeof(header) &&
           header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == device->vendorID && header.deviceID == device->deviceID &&
           memcmp(header.pipelineCacheUUID, device->pipelineCacheUUID, VK_UUID_SIZE) == 0 &&
           stored == hash(data, size);
}

/* The folder "$XDG_CACHE_HOME/firn"; only absolute paths count. */
static bool find_folder(char *folder, size_t size)
{
    const char *cache = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    int length = -1;
    if (cache && cache[0] == '/')
        length = snprintf(folder, size, "%s/firn", cache);
    else if (home && home[0] == '/')
        length = snprintf(folder, size, "%s/.cache/firn", home);
    return length > 0 && (size_t)length < size;
}

static bool find_path(const struct gpu *gpu, const char *folder, char *path, size_t size)
{
    char uuid[2 * VK_UUID_SIZE + 1];
    for (size_t i = 0; i < VK_UUID_SIZE; i++)
        snprintf(uuid + 2 * i, 3, "%02x", gpu->properties.pipelineCacheUUID[i]);
    const int length = snprintf(path, size, "%s/pipelines-%04x-%04x-%s", folder,
                                gpu->properties.vendorID, gpu->properties.deviceID, uuid);
    return length > 0 && (size_t)length < size;
}

static bool read_all(int file, char *data, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t got = read(file, data + done, size - done);
        if (got <= 0)
            return false;
        done += (size_t)got;
    }
    return true;
}

static bool write_all(int file, const char *data, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t put = write(file, data + done, size - done);
        if (put <= 0)
            return false;
        done += (size_t)put;
    }
    return true;
}

/* Returns whether only the user can have written a file or folder, since drivers trust the data. */
static bool is_own(const struct stat *info)
{
    return info->st_uid == geteuid() && !(info->st_mode & (S_IWGRP | S_IWOTH));
}

/* Returns the undamaged content of the file, hash included, or NULL; the caller frees it. A missing
 * file is no error. */
static void *read_sound(const struct gpu *gpu, size_t *size)
{
    char folder[2048];
    char path[2200];
    struct stat info, folder_info;
    char *data = NULL;
    if (!find_folder(folder, sizeof(folder)) || !find_path(gpu, folder, path, sizeof(path)))
        return NULL;
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return NULL;
    const bool is_regular = fstat(file, &info) == 0 && S_ISREG(info.st_mode);
    if (is_regular && !(is_own(&info) && stat(folder, &folder_info) == 0 && is_own(&folder_info))) {
        close(file);
        log_warning("%s: ignored because other users can write it or its folder", path);
        return NULL;
    }
    if (is_regular && info.st_size > 0 && info.st_size <= FILE_SIZE_MAX) {
        *size = (size_t)info.st_size;
        data = malloc(*size);
    }
    if (data && (!read_all(file, data, *size) || !gpu_cache_sound(&gpu->properties, data, *size))) {
        free(data);
        data = NULL;
    }
    close(file);
    if (!data)
        log_warning("%s: ignored because it is damaged; it will be rewritten", path);
    return data;
}

enum status gpu_cache_load(struct gpu *gpu)
{
    size_t size = 0;
    void *data = gpu->no_cache ? NULL : read_sound(gpu, &size);
    VkPipelineCacheCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
        .initialDataSize = data ? size - HASH_SIZE : 0,
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

/* Returns the driver's data followed by their hash; the caller frees them. */
static char *get_data(const struct gpu *gpu, size_t *size)
{
    size_t used = 0;
    if (vkGetPipelineCacheData(gpu->device, gpu->pipeline_cache, &used, NULL) != VK_SUCCESS ||
        used == 0 || used > FILE_SIZE_MAX - HASH_SIZE)
        return NULL;
    char *data = malloc(used + HASH_SIZE);
    if (!data)
        return NULL;
    if (vkGetPipelineCacheData(gpu->device, gpu->pipeline_cache, &used, data) != VK_SUCCESS) {
        free(data);
        return NULL;
    }
    const uint64_t value = hash((const unsigned char *)data, used);
    memcpy(data + used, &value, HASH_SIZE);
    *size = used + HASH_SIZE;
    return data;
}

/* Makes the folder, and its parent (~/.cache) if that is missing. */
static void make_folder(char *folder)
{
    char *slash = strrchr(folder, '/');
    *slash = '\0';
    (void)mkdir(folder, 0700);
    *slash = '/';
    (void)mkdir(folder, 0700);
}

void gpu_cache_save(const struct gpu *gpu)
{
    char folder[2048];
    char path[2200];
    char temporary[2256];
    size_t size = 0;
    if (!find_folder(folder, sizeof(folder)) || !find_path(gpu, folder, path, sizeof(path)))
        return;
    char *data = get_data(gpu, &size);
    if (!data)
        return;
    make_folder(folder);
    snprintf(temporary, sizeof(temporary), "%s.XXXXXX", path);
    const int file = mkstemp(temporary);
    if (file >= 0) {
        const bool written = write_all(file, data, size);
        const bool closed = close(file) == 0;
        if (!written || !closed || rename(temporary, path) != 0)
            (void)unlink(temporary);
    }
    free(data);
}
