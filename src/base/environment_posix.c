/* environment_posix.c: environment variables by POSIX functions. */
#define _GNU_SOURCE /* secure_getenv(), putenv() */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/environment.h"

bool environment_set_default(const char *name, const char *value)
{
    return setenv(name, value, 0) == 0;
}

const char *environment_get_secure(const char *name)
{
    return secure_getenv(name);
}

bool environment_reserve(const char *name, size_t size)
{
    char *variable = malloc(strlen(name) + 1 + size);
    if (!variable)
        return false;
    sprintf(variable, "%s=", name);
    if (putenv(variable) == 0)
        return true; /* NOLINT(clang-analyzer-unix.Malloc): the environment keeps it */
    free(variable);
    return false;
}

/* Changes the value in place: setenv() would race with threads that read the environment. */
void environment_fill(const char *name, const char *value)
{
    char *old = getenv(name);
    if (old)
        memcpy(old, value, strlen(value) + 1);
}
