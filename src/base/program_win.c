/* program_win.c: finds the running program on Windows. Its path gets slashes. */
#include <string.h>
#include <windows.h>
#include "src/base/program.h"

bool program_path(char path[static PROGRAM_PATH_SIZE], const char *relative)
{
    const DWORD length = GetModuleFileNameA(NULL, path, PROGRAM_PATH_SIZE);
    path[length < PROGRAM_PATH_SIZE ? length : 0] = '\0';
    for (char *c = path; *c; c++)
        *c = *c == '\\' ? '/' : *c;
    char *slash = strrchr(path, '/');
    if (slash && !relative)
        return true;
    if (!slash || (size_t)(slash + 1 - path) + strlen(relative) >= PROGRAM_PATH_SIZE)
        return false;
    memcpy(slash + 1, relative, strlen(relative) + 1);
    return true;
}
