/*
 * font.h: lookup of the system font for the user interface.
 */
#ifndef FIRN_VIEW_UI_FONT_H
#define FIRN_VIEW_UI_FONT_H

#include <stdbool.h>

enum {
    FONT_PATH_SIZE = 1024,
};

struct font {
    char path[FONT_PATH_SIZE];
    int index; /* index of the face in the font file */
};

/* Finds the scalable font that fontconfig prefers for `family` ("sans", "monospace"). Returns
 * false, with *font {0}, if there is none or firn was built without fontconfig. */
bool font_find(struct font *font, const char *family);

#endif
