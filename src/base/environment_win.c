/* environment_win.c: environment variables on Windows, where none can be empty. */
#include <stdlib.h>
#include "src/base/environment.h"

bool environment_set_default(const char *name, const char *value)
{
    return getenv(name) || _putenv_s(name, value) == 0;
}

const char *environment_get_secure(const char *name)
{
    return getenv(name);
}

bool environment_reserve(const char *name, size_t size)
{
    (void)name;
    (void)size;
    return false;
}

void environment_fill(const char *name, const char *value)
{
    (void)_putenv_s(name, value);
}
