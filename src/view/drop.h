/* drop.h: kinds of files that can be opened or dropped onto the window. */
#ifndef FIRN_VIEW_DROP_H
#define FIRN_VIEW_DROP_H

#include "src/reader/reader.h"

enum drop {
    DROP_MODEL,       /* a model file or the name of a scene; the default if nothing else matches */
    DROP_ENVIRONMENT, /* a panorama file, or the name of a built-in environment */
    DROP_PICTURE,     /* an image to compare with */
    DROP_PRESET, /* a text file of settings, or a PNG image in which firn stored its settings */
    DROP_SESSION,
};

/*
 * Detects the kind of a file from its extension and, for images, from the contents: a PNG file
 * without firn's settings is an image to compare, and so is an .exr or .hdr file that does not have
 * the aspect ratio of a panorama. Image files are read in a reader process (see reader.h for
 * errors); *drop is set only on success.
 */
MUST_USE enum status drop_find(const char *path, const struct reader_params *reader,
                               enum drop *drop);

#endif
