/* system_font.h: lookup of the system font for the user interface. */
#ifndef FIRN_VIEW_PANELS_SYSTEM_FONT_H
#define FIRN_VIEW_PANELS_SYSTEM_FONT_H

#include <stdbool.h>

enum {
    SYSTEM_FONT_PATH_SIZE = 1024,
};

struct system_font {
    char path[SYSTEM_FONT_PATH_SIZE];
    int index; /* index of the font face */
};

/* Finds the scalable font that fontconfig prefers for `family` ("sans", "monospace"). If no font is
 * found, or without fontconfig in the build, zeroes *font and returns false. */
bool system_font_find(struct system_font *font, const char *family);

#endif
