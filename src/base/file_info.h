/* file_info.h: kind, size and identity of files, and positions beyond 2 GiB. Any thread may call
 * these functions. */
#ifndef FIRN_BASE_FILE_INFO_H
#define FIRN_BASE_FILE_INFO_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum file_kind {
    FILE_MISSING, /* or its folder cannot be searched; errno says why */
    FILE_REGULAR,
    FILE_FOLDER,
    FILE_OTHER, /* pipe, device, socket */
};

struct file_info {
    enum file_kind kind;
    int64_t size;           /* bytes, of a regular file */
    uint64_t volume, index; /* identify a file, see file_info_is_same() */
};

/* Describes the file at `path`, following symbolic links. */
struct file_info file_info_of(const char *path);

/* Describes an open file. The kind is FILE_MISSING on failure. */
struct file_info file_info_of_open(FILE *file);

/* Returns true if both describe the same existing file. */
static inline bool file_info_is_same(const struct file_info *a, const struct file_info *b)
{
    return a->kind != FILE_MISSING && b->kind != FILE_MISSING && a->volume == b->volume &&
           a->index == b->index;
}

/* Returns true if `path` is a symbolic link. */
bool file_is_link(const char *path);

/* Returns true if the program may read the file. If not, errno says why. */
bool file_is_readable(const char *path);

/* Sets the position of a file to `offset` bytes from its start. Returns false on failure. */
bool file_seek(FILE *file, int64_t offset);

#endif
