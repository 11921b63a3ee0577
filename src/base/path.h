/* path.h: file name helpers. */
#ifndef FIRN_BASE_PATH_H
#define FIRN_BASE_PATH_H

#include <stdbool.h>

/* Returns true if a file name ends in an extension such as ".exr", ignoring case. */
bool path_ends_in(const char *path, const char *ending);

#endif
