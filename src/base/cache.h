/*
 * cache.h: files that save time alone, in "$XDG_CACHE_HOME/firn" or ~/.cache/firn.
 *
 * Each ends with a hash of what is before. Nothing that goes wrong with them is an error: then
 * what they hold is made anew.
 *
 * Thread-safety: any thread may call these, but environment variables must not change meanwhile.
 */
#ifndef FIRN_BASE_CACHE_H
#define FIRN_BASE_CACHE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    CACHE_HASH_SIZE = sizeof(uint64_t),
};

struct cache_file {
    const char *name; /* without a folder; at most 100 characters */
    size_t size_max;  /* bytes, with the hash */
    bool is_quiet;    /* no line tells of damage */
    /* Whether the content, with its hash, can be used: cache_is_whole() and more. */
    bool (*is_sound)(const void *user, const void *data, size_t size);
    const void *user; /* for is_sound() */
};

/* Returns whether data end with the hash of what is before. */
bool cache_is_whole(const void *data, size_t size);

/* Returns the sound content of a file, hash included, or NULL; the caller frees it. The file then
 * counts as just used. A missing file is no error; one that other users can write is ignored with
 * a warning, and so is a damaged one, unless it is quiet. */
void *cache_read(const struct cache_file *wanted, size_t *size);

/* Writes a file, which is then whole, or as it was; only the user can read it. CACHE_HASH_SIZE
 * bytes behind the `size` bytes of data are for the hash. Failures are not logged. */
void cache_write(const char *name, void *data, size_t size);

/* Removes files whose names begin so, those first that were used longest ago, until the others
 * have at most so many bytes. */
void cache_trim(const char *beginning, uint64_t most);

#endif
