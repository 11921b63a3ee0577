/*
 * disk_cache.h: caches recomputable data on disk, in "$XDG_CACHE_HOME/firn" or ~/.cache/firn. Each
 * file ends with a hash of its contents. Failures are not errors, because the caller recomputes the
 * data. Any thread may call these functions, but not while a thread changes environment variables.
 */
#ifndef FIRN_BASE_DISK_CACHE_H
#define FIRN_BASE_DISK_CACHE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    DISK_CACHE_HASH_SIZE = sizeof(uint64_t),
};

/* Sets the folder for the calling thread, an absolute path that must outlive its use, and returns
 * the earlier one. NULL stands for the default folder. */
const char *disk_cache_set_folder(const char *folder);

/* Returns the folder of the calling thread, or NULL for the default folder. */
const char *disk_cache_get_folder(void);

struct disk_cache_file {
    const char *name; /* without folder; at most 100 characters */
    size_t size_max;  /* maximum bytes including the hash */
    bool is_quiet;    /* do not warn about damaged files */
    /* Callback that returns true if the data is usable. It must call disk_cache_is_intact(). */
    bool (*is_sound)(const void *user, const void *data, size_t size);
    const void *user; /* argument of is_sound() */
};

/* Returns the 64-bit FNV-1a hash of `data`, which detects damaged cache files. */
uint64_t disk_cache_hash(const void *data, size_t size);

/* Returns true if the last DISK_CACHE_HASH_SIZE bytes are the hash of the preceding bytes. */
bool disk_cache_is_intact(const void *data, size_t size);

/* Returns a file's data and hash, which the caller frees. Marks the file as just used. If the file
 * is missing, returns NULL. If other users can write to the file or its folder, warns and returns
 * NULL. If is_sound() rejects the data, returns NULL, and warns unless is_quiet. */
void *disk_cache_read(const struct disk_cache_file *request, size_t *size);

/* Writes `data` and its hash to a file atomically. Only the user may read the file. `data` needs
 * DISK_CACHE_HASH_SIZE spare bytes for the hash after `size` bytes. Failures are not logged. */
void disk_cache_write(const char *name, void *data, size_t size);

/* Deletes least recently used files with a name prefix until at most `bytes_max` bytes remain. */
void disk_cache_evict(const char *prefix, uint64_t bytes_max);

#endif
