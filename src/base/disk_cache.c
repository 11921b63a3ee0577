/* disk_cache.c: the folder of a thread's cache files, and content hashes. */
#include "src/base/disk_cache.h"
#include <string.h>

static _Thread_local const char *thread_folder;

const char *disk_cache_set_folder(const char *folder)
{
    const char *earlier = thread_folder;
    thread_folder = folder;
    return earlier;
}

const char *disk_cache_get_folder(void)
{
    return thread_folder;
}

uint64_t disk_cache_hash(const void *data, size_t size)
{
    const unsigned char *bytes = data;
    uint64_t value = 0xcbf29ce484222325;
    for (size_t i = 0; i < size; i++)
        value = (value ^ bytes[i]) * 0x100000001b3;
    return value;
}

bool disk_cache_is_intact(const void *data, size_t size)
{
    uint64_t stored = 0;
    if (size < DISK_CACHE_HASH_SIZE)
        return false;
    size -= DISK_CACHE_HASH_SIZE;
    memcpy(&stored, (const char *)data + size, DISK_CACHE_HASH_SIZE);
    return stored == disk_cache_hash(data, size);
}
