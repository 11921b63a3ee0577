/* path.h: names of files. */
#ifndef FIRN_BASE_PATH_H
#define FIRN_BASE_PATH_H

#include <stdbool.h>

/* Whether a name's extension is `ending`, dot included: ".exr". */
bool path_ends_in(const char *path, const char *ending);

#endif
