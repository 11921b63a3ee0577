/*
 * font.h: which font of the system the panels are written in.
 */
#ifndef FIRN_VIEW_UI_FONT_H
#define FIRN_VIEW_UI_FONT_H

#include <stdbool.h>

enum {
    FONT_PATH_SIZE = 1024,
};

struct font {
    char path[FONT_PATH_SIZE];
    int index; /* of the face in the file */
};

/* Finds the scalable font that fontconfig takes for `family` ("sans", "monospace"). False: there is
 * none, or firn was built without fontconfig; *font is then {0}. */
bool font_find(struct font *font, const char *family);

#endif
