/*
 * report.h: what became of each frame, as JSON, for programs that start firn render.
 */
#ifndef FIRN_APP_REPORT_H
#define FIRN_APP_REPORT_H

#include <stddef.h>
#include <stdint.h>
#include "src/app/sequence.h"
#include "src/base/status.h"

enum report_state {
    REPORT_LEFT,    /* it was not its turn yet */
    REPORT_DRAWN,   /* and all its files written */
    REPORT_CURRENT, /* --resume has found all its files */
    REPORT_FAILED,
    REPORT_STATE_COUNT,
};

struct report_frame {
    enum report_state state;
    double seconds;
    char hash[17]; /* of report_hash(); "": not known yet */
};

struct report {
    struct report_frame *frames; /* as those of the sequence */
    uint32_t count;
};

/* All frames are left. Logs: STATUS_TRY_AGAIN. */
MUST_USE enum status report_init(struct report *report, uint32_t count);

void report_finish(struct report *report); /* {0} is fine */

/*
 * 16 hexadecimal digits that stand for this firn's version and a frame's firn/settings (FNV-1a, 64
 * bits): the same on all machines, another one when --resume would draw the frame again.
 */
void report_hash(const char *settings, char hash[static 17]);

/* Whether some frames have failed and others are there. */
bool report_is_mixed(const struct report *report);

/*
 * Everything as JSON text, ended by a newline, which the caller frees; `code` is what the program
 * ends with. NULL when memory is short.
 */
char *report_json(const struct report *report, const struct sequence *sequence,
                  const struct app_options *options, int code, size_t *size);

#endif
