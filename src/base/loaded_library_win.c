/* loaded_library_win.c: finds functions of loaded libraries on Windows. */
#include <stdio.h>
#include <string.h>
#include <windows.h>
#include "src/base/loaded_library.h"

void *loaded_library_find(const char *library, const char *symbol)
{
    char name[64];
    void *found = NULL;
    snprintf(name, sizeof(name), "%s.dll", library);
    const HMODULE module = GetModuleHandleA(name);
    const FARPROC function = module ? GetProcAddress(module, symbol) : NULL;
    memcpy(&found, &function, sizeof(found)); /* ISO C forbids the cast */
    return found;
}
