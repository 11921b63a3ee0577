/* path.h: functions on names of files. */
#ifndef FIRN_BASE_PATH_H
#define FIRN_BASE_PATH_H

#include <stdbool.h>

/* Returns whether a name's extension is `ending`, which includes the dot: ".exr". Upper and lower
 * case are the same. */
bool path_ends_in(const char *path, const char *ending);

#endif
