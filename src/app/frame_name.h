/*
 * frame_name.h: where the number of a frame goes in the name of a file.
 *
 * The field is a run of '#', or one of C's printf(), "%d" or "%04d", in the name itself; folders
 * are taken as they are. "####" pads with zeros to as many digits and puts a sign before them
 * (-0012); "%04d" counts the sign, as in C (-012). Longer numbers get longer names.
 */
#ifndef FIRN_APP_FRAME_NAME_H
#define FIRN_APP_FRAME_NAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"

struct frame_name {
    const char *path;  /* borrowed */
    size_t at, length; /* of the field; length 0: there is none */
    int width;         /* of the number; 0: as long as it is */
    bool hashes;       /* the width is that of the digits, without the sign */
};

/*
 * Takes a path that may have one field. More of them, or a '%' in the name that begins none, is
 * logged: STATUS_USAGE.
 */
MUST_USE enum status frame_name_parse(struct frame_name *name, const char *path);

/*
 * Whether somebody who writes this surely means a field: "##" or "%d". A single '#' is as likely
 * part of a name.
 */
bool frame_name_is_pattern(const char *path);

/* The path of a frame, malloc'd; NULL when memory is short. */
char *frame_name_make(const struct frame_name *name, int32_t frame);

#endif
