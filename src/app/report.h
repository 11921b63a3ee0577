/* report.h: JSON report of each frame's outcome, for programs that run firn render. */
#ifndef FIRN_APP_REPORT_H
#define FIRN_APP_REPORT_H

#include <stddef.h>
#include <stdint.h>
#include "src/app/sequence.h"
#include "src/base/status.h"

enum report_state {
    REPORT_LEFT,    /* not started */
    REPORT_DRAWN,   /* drawn, and all files written */
    REPORT_CURRENT, /* --resume found all files current */
    REPORT_FAILED,
    REPORT_STATE_COUNT,
};

struct report_frame {
    enum report_state state;
    double seconds;
    char hash[17]; /* set by report_hash(); "" if not known yet */
};

struct report {
    struct report_frame *frames; /* in the order of the sequence */
    uint32_t count;
};

/* Sets all frames to REPORT_LEFT. On failure logs and returns STATUS_TRY_AGAIN. */
MUST_USE enum status report_init(struct report *report, uint32_t count);

void report_finish(struct report *report); /* {0} is fine */

/*
 * Writes a hash of firn's version and a frame's firn/settings (FNV-1a, 64 bits) as 16 hexadecimal
 * digits. It is the same on all machines, and changes when --resume would draw the frame again.
 */
void report_hash(const char *settings, char hash[static 17]);

/* Returns true if some frames have failed and others are complete. */
bool report_is_mixed(const struct report *report);

/*
 * Returns the report as JSON text ended by a newline, to be freed by the caller; NULL when out of
 * memory. `code` is the exit code of the program.
 */
char *report_json(const struct report *report, const struct sequence *sequence,
                  const struct app_options *options, int code, size_t *size);

#endif
