/* frame_name.h: the frame-number field in the name of an output file: a run of '#', or one of C's
 * printf(), "%d" or "%04d"; folders are not searched. "####" pads with zeros to as many digits and
 * puts a sign before them (-0012); "%04d" counts the sign, as in C (-012). Numbers with more digits
 * make the name longer. */
#ifndef FIRN_APP_FRAME_NAME_H
#define FIRN_APP_FRAME_NAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"

struct frame_name {
    const char *path;  /* borrowed */
    size_t at, length; /* of the field */
    int width;         /* minimum width; 0: no padding */
    bool hashes;       /* the width excludes the sign */
};

/* Parses a path with at most one frame-number field. Otherwise logs and returns STATUS_USAGE. */
MUST_USE enum status frame_name_parse(struct frame_name *name, const char *path);

/* Returns true if a path has a frame-number field such as "##" or "%d". A single '#' is not one. */
bool frame_name_is_pattern(const char *path);

/* Returns the path of a frame, which the caller frees, or NULL when out of memory. */
char *frame_name_make(const struct frame_name *name, int32_t frame);

#endif
