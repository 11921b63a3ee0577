/* loaded_library.h: finds functions of shared libraries that the process has loaded. */
#ifndef FIRN_BASE_LOADED_LIBRARY_H
#define FIRN_BASE_LOADED_LIBRARY_H

/* Returns the address of a symbol of a library, such as "renderdoc" for librenderdoc.so or
 * renderdoc.dll. Returns NULL if the library is not loaded or lacks the symbol. */
void *loaded_library_find(const char *library, const char *symbol);

#endif
