/*
 * disk_cache.h: disk cache of files that only save time, in "$XDG_CACHE_HOME/firn" or
 * ~/.cache/firn.
 *
 * Each file ends with a hash of its contents. No failure is an error: the caller then recomputes
 * the data.
 *
 * Thread-safety: any thread may call these, but environment variables must not change meanwhile.
 */
#ifndef FIRN_BASE_DISK_CACHE_H
#define FIRN_BASE_DISK_CACHE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    DISK_CACHE_HASH_SIZE = sizeof(uint64_t),
};

struct disk_cache_file {
    const char *name; /* file name without a folder; at most 100 characters */
    size_t size_max;  /* bytes including the hash */
    bool is_quiet;    /* do not warn about damaged files */
    /* Returns true if the data with its hash is usable: disk_cache_is_intact() and further checks.
     */
    bool (*is_sound)(const void *user, const void *data, size_t size);
    const void *user; /* for is_sound() */
};

/* Returns true if the data ends with the hash of the rest. */
bool disk_cache_is_intact(const void *data, size_t size);

/* Returns the contents of a file that passes is_sound(), including the hash, or NULL; the caller
 * frees it. The file is marked as just used. A missing file is no error. A file that other users
 * can write is ignored with a warning, and so is a damaged one unless is_quiet is set. */
void *disk_cache_read(const struct disk_cache_file *wanted, size_t *size);

/* Writes a file atomically, readable only by the user. `data` must have DISK_CACHE_HASH_SIZE
 * writable bytes after its `size` bytes for the hash. Failures are not logged. */
void disk_cache_write(const char *name, void *data, size_t size);

/* Evicts least recently used files with a name prefix, until the rest has at most `most` bytes. */
void disk_cache_evict(const char *beginning, uint64_t most);

#endif
