/* sequence_frame_list.h: frame list, frame times and output file names of a command line. */
#ifndef FIRN_APP_SEQUENCE_FRAME_LIST_H
#define FIRN_APP_SEQUENCE_FRAME_LIST_H

#include "src/app/app.h"
#include "src/app/frame_name.h"
#include "src/app/options/frame_range.h"

struct sequence {
    struct frame_range range; /* without --frames: frame 0 */
    struct frame_name names[SETUP_OUTPUT_COUNT];
};

/* Parses --frames, --chunk and the frame-number fields of output names. If no output is named, adds
 * the default output. The options must outlive *sequence. Logs errors. */
MUST_USE enum status sequence_parse(struct sequence *sequence, struct app_options *options);

/* Returns the time of a frame in seconds. */
double sequence_time(const struct settings *settings, int32_t frame);

/* Checks that every file can be created and that every frame's time is in the range of motion.time.
 * If not, logs an error and returns STATUS_USAGE, STATUS_CANT_CREATE or STATUS_TRY_AGAIN. */
MUST_USE enum status sequence_check(const struct sequence *sequence,
                                    const struct app_options *options);

void sequence_finish(struct sequence *sequence); /* {0} is fine */

#endif
