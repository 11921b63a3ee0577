/* path.h: file name helpers. */
#ifndef FIRN_BASE_PATH_H
#define FIRN_BASE_PATH_H

#include <stdbool.h>
#include <string.h>
#include "src/base/ascii.h"

/* Returns true if a file name ends in an extension such as ".exr", ignoring case. */
static inline bool path_ends_in(const char *path, const char *ending)
{
    const char *dot = strrchr(path, '.');
    return dot && ascii_begins_equal(dot, ending, strlen(ending) + 1);
}

#endif
