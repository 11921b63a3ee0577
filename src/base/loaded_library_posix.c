/* loaded_library_posix.c: finds functions of loaded libraries by dlopen(). */
#include <dlfcn.h>
#include <stdio.h>
#include "src/base/loaded_library.h"

void *loaded_library_find(const char *library, const char *symbol)
{
    char name[64];
    snprintf(name, sizeof(name), "lib%s.so", library);
    void *handle = dlopen(name, RTLD_NOW | RTLD_NOLOAD);
    void *found = handle ? dlsym(handle, symbol) : NULL;
    if (handle)
        dlclose(handle); /* drops the reference from dlopen(), but the library stays loaded */
    return found;
}
