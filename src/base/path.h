/* path.h: file name functions. */
#ifndef FIRN_BASE_PATH_H
#define FIRN_BASE_PATH_H

#include <stdbool.h>

/* Returns true if a file name's extension is `ending`, with the dot (".exr"), ignoring case. */
bool path_ends_in(const char *path, const char *ending);

#endif
