/*
 * ui_times.h: what each pass takes, as bars.
 */
#ifndef FIRN_VIEW_UI_UI_TIMES_H
#define FIRN_VIEW_UI_UI_TIMES_H

#include "graph/rg_time.h"

enum {
    UI_TIMES_ROW_COUNT = 96, /* more are left out */
};

/* A row of the frame's tables, with all its repetitions. */
struct ui_times_row {
    char name[64]; /* cut; the plan may be gone when it is shown */
    uint32_t repetition_count;
    double milliseconds; /* a running mean */
};

struct ui_times {
    struct ui_times_row rows[UI_TIMES_ROW_COUNT];
    uint32_t row_count;
};

/* Takes a frame in; nothing if it was not measured. Rows of another plan begin anew. */
void ui_times_add(struct ui_times *times, const struct rg_plan *plan, const struct rg_times *frame);

double ui_times_sum(const struct ui_times *times); /* milliseconds */

/* `what`: whose times they are. */
void ui_times_panel(const char *what, const struct ui_times *times);

#endif
