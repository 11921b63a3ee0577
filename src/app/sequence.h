/*
 * sequence.h: which frames a command line names, when they are, and in which files.
 */
#ifndef FIRN_APP_SEQUENCE_H
#define FIRN_APP_SEQUENCE_H

#include "src/app/app.h"
#include "src/app/frame_name.h"
#include "src/app/options/frame_range.h"

struct sequence {
    struct frame_range range; /* without --frames: frame 0 */
    struct frame_name names[APP_OUTPUT_COUNT];
};

/*
 * Finds what is wrong with the words: --frames, --chunk and places for numbers in names. Without
 * --output adds the file that firn render writes. The options must outlive *sequence. Logs:
 * STATUS_USAGE or STATUS_TRY_AGAIN.
 */
MUST_USE enum status sequence_parse(struct sequence *sequence, struct app_options *options);

/* Seconds at which a frame is. */
double sequence_time(const struct settings *settings, int32_t frame);

/*
 * Whether every file can be created, and every frame has a time that --set motion.time takes. Logs
 * what is wrong: STATUS_USAGE, STATUS_CANT_CREATE or STATUS_TRY_AGAIN.
 */
MUST_USE enum status sequence_check(const struct sequence *sequence,
                                    const struct app_options *options);

void sequence_finish(struct sequence *sequence); /* {0} is fine */

#endif
