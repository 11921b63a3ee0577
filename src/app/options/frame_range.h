/*
 * frame_range.h: list of frame numbers, as given with --frames.
 *
 * Grammar: list = item { "," item }; item = frame | frame "-" frame [ "x" step ]; frame = [ "-" ]
 * digits.
 *
 * "1-10x3" is 1 4 7 10, "10-1x3" is 10 7 4 1, "-4--2" is -4 -3 -2: a range goes from the first
 * number towards the second, never past it. Repeated frames are dropped.
 */
#ifndef FIRN_APP_OPTIONS_FRAME_RANGE_H
#define FIRN_APP_OPTIONS_FRAME_RANGE_H

#include <stdint.h>
#include "src/base/status.h"

enum {
    FRAME_RANGE_MAX = 9999999,     /* limit of frame numbers and steps */
    FRAME_RANGE_COUNT_MAX = 100000 /* maximum number of frames */
};

struct frame_range {
    int32_t *frames; /* in list order, none twice */
    uint32_t count;
};

/* Parses a frame list. On failure clears *range, logs one line and returns STATUS_USAGE, or
 * STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status frame_range_parse(struct frame_range *range, const char *text);

/* Keeps only chunk k (1 to n) of the list; the chunk may be empty. The n chunks (n up to 1000000)
 * are consecutive and equally long, give or take one. The split depends only on the list and n. */
void frame_range_chunk(struct frame_range *range, uint32_t k, uint32_t n);

void frame_range_finish(struct frame_range *range); /* {0} is fine */

#endif
