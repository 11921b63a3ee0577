/* path.c: file name helpers. */
#include "src/base/path.h"
#include <string.h>
#include <strings.h>

bool path_ends_in(const char *path, const char *ending)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ending) == 0;
}
