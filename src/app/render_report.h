/* render_report.h: JSON report of each frame's outcome, for programs that run firn render. */
#ifndef FIRN_APP_RENDER_REPORT_H
#define FIRN_APP_RENDER_REPORT_H

#include <stddef.h>
#include <stdint.h>
#include "src/app/sequence_frame_list.h"
#include "src/base/status.h"

enum render_report_state {
    RENDER_REPORT_NOT_STARTED,
    RENDER_REPORT_DRAWN,   /* drawn, and all files written */
    RENDER_REPORT_CURRENT, /* --resume found all files current */
    RENDER_REPORT_FAILED,
    RENDER_REPORT_STATE_COUNT,
};

struct render_report_frame {
    enum render_report_state state;
    double seconds;
    char hash[17]; /* render_report_hash(), or "" */
};

/* Camera and exposure that were chosen. Positions are in the coordinates of the model file. */
struct render_report_view {
    double eye[3], target[3];
    double fov_deg;  /* 0 for an orthographic camera */
    double exposure; /* stops */
};

struct report {
    struct render_report_frame *frames; /* in the order of the sequence */
    uint32_t count;
    struct render_report_view view; /* at the time of frame 0 */
};

/* Sets all frames to RENDER_REPORT_NOT_STARTED. On failure logs and returns STATUS_TRY_AGAIN. */
MUST_USE enum status render_report_init(struct report *report, uint32_t count);

void render_report_finish(struct report *report); /* {0} is fine */

/* Hashes firn's version and a frame's settings to 16 hexadecimal digits (64-bit FNV-1a). All
 * machines compute the same hash. If a frame's hash has changed, --resume draws the frame again. */
void render_report_hash(const char *settings, char hash[static 17]);

/* Returns the report as JSON text, which the caller frees. If out of memory, returns NULL. `code`
 * is the exit code of the program. */
char *render_report_json(const struct report *report, const struct sequence *sequence,
                         const struct app_options *options, int code, size_t *size);

#endif
