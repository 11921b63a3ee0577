/* drop.h: what a file is that was dropped onto the window. */
#ifndef FIRN_VIEW_DROP_H
#define FIRN_VIEW_DROP_H

#include "src/reader/reader.h"

enum drop {
    DROP_MODEL,       /* or the name of a scene: what nothing else is */
    DROP_ENVIRONMENT, /* a panorama, or the name of one */
    DROP_PICTURE,     /* to compare with */
    DROP_PRESET,      /* settings as lines, or a PNG picture of firn, which has them in it */
    DROP_SESSION,
};

/*
 * Finds that by the end of the name and, of pictures, by what they are: a PNG file without firn's
 * settings is a picture, and so is an .exr or .hdr file that has not the shape of a panorama. Such
 * files are read by a reader process (reader.h, with its errors); *drop is set on success alone.
 */
MUST_USE enum status drop_find(const char *path, const struct reader_params *reader,
                               enum drop *drop);

#endif
