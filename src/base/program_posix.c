/* program_posix.c: finds the running program through /proc. */
#include <string.h>
#include <unistd.h>
#include "src/base/program.h"

bool program_path(char path[static PROGRAM_PATH_SIZE], const char *relative)
{
    const ssize_t length = readlink("/proc/self/exe", path, PROGRAM_PATH_SIZE - 1);
    path[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(path, '/');
    if (slash && !relative)
        return true;
    if (!slash || (size_t)(slash + 1 - path) + strlen(relative) >= PROGRAM_PATH_SIZE)
        return false;
    memcpy(slash + 1, relative, strlen(relative) + 1);
    return true;
}
