/* temporary_folder.c: a temporary working directory for each test. */
#include "tests/support/temporary_folder.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int temporary_folder_enter(void **state)
{
    char name[] = "/tmp/firn-test-files-XXXXXX";
    if (!mkdtemp(name) || chmod(name, 0755) != 0 || chdir(name) != 0)
        return -1;
    *state = strdup(name);
    return *state ? 0 : -1;
}

int temporary_folder_leave(void **state)
{
    DIR *folder = opendir(".");
    const struct dirent *entry;

    if (!folder)
        return -1;
    while ((entry = readdir(folder)))
        (void)remove(entry->d_name);
    closedir(folder);
    const int result = chdir("/") == 0 && rmdir(*state) == 0 ? 0 : -1;
    free(*state);
    return result;
}
