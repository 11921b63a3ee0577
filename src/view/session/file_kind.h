/* file_kind.h: kinds of files that can be opened or dropped onto the window. */
#ifndef FIRN_VIEW_SESSION_FILE_KIND_H
#define FIRN_VIEW_SESSION_FILE_KIND_H

#include "src/file/reader_process.h"

enum opened_kind {
    FILE_KIND_MODEL,       /* model file or scene name (default) */
    FILE_KIND_ENVIRONMENT, /* panorama file or built-in environment */
    FILE_KIND_IMAGE,       /* an image to compare with */
    /* settings file, or firn's PNG */
    FILE_KIND_PRESET,
    FILE_KIND_SESSION,
};

/* Detects the kind of a file from its extension and, for images, from the contents: a PNG file
 * without firn's settings is an image to compare, and so is an .exr or .hdr file that does not have
 * the aspect ratio of a panorama. Image files are read in a reader process (see reader_process.h
 * for errors); *kind is set only on success. */
MUST_USE enum status file_kind_detect(const char *path, const struct reader_params *reader,
                                      enum opened_kind *kind);

#endif
