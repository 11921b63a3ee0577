/*
 * frame_range.h: which frames, as --frames names them.
 *
 *     list  = item { "," item }
 *     item  = frame | frame "-" frame [ "x" step ]
 *     frame = [ "-" ] digits
 *
 * "1-10x3" is 1 4 7 10, "10-1x3" is 10 7 4 1, "-4--2" is -4 -3 -2: a range goes from the first
 * number towards the second, never past it. A frame that comes again is dropped.
 */
#ifndef FIRN_APP_OPTIONS_FRAME_RANGE_H
#define FIRN_APP_OPTIONS_FRAME_RANGE_H

#include <stdint.h>
#include "src/base/status.h"

enum {
    FRAME_RANGE_MAX = 9999999,     /* frames go from -FRAME_RANGE_MAX to it; steps from 1 */
    FRAME_RANGE_COUNT_MAX = 100000 /* different frames of one list */
};

struct frame_range {
    int32_t *frames; /* in the order of the list, none twice */
    uint32_t count;
};

/*
 * Logs what is wrong with the text in one line: STATUS_USAGE; or STATUS_TRY_AGAIN when memory is
 * short. *range is then {0}.
 */
MUST_USE enum status frame_range_parse(struct frame_range *range, const char *text);

/* Keeps part k (from 1) of n (to 1000000) in a row, of sizes that differ by one at most; a part may
 * be empty. The same list gives the same parts everywhere. */
void frame_range_chunk(struct frame_range *range, uint32_t k, uint32_t n);

void frame_range_finish(struct frame_range *range); /* {0} is fine */

#endif
