/* ascii.h: comparison of ASCII texts that ignores case, in any locale. */
#ifndef FIRN_BASE_ASCII_H
#define FIRN_BASE_ASCII_H

#include <stdbool.h>
#include <stddef.h>

static inline int ascii_lower(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

/* Returns true if the first `size` characters are equal, or the whole texts if they are shorter. */
static inline bool ascii_begins_equal(const char *a, const char *b, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        if (ascii_lower(a[i]) != ascii_lower(b[i]))
            return false;
        if (!a[i])
            return true;
    }
    return true;
}

#endif
