/* ui_pass_times.h: GPU times of passes: running means, and a history of the last frames. */
#ifndef FIRN_VIEW_PANELS_UI_PASS_TIMES_H
#define FIRN_VIEW_PANELS_UI_PASS_TIMES_H

#include "graph/rg_profile.h"

enum {
    UI_PASS_TIMES_ROW_COUNT = 96,    /* maximum rows; further passes are omitted */
    UI_PASS_TIMES_FRAME_COUNT = 120, /* recorded frames; older ones are dropped */
};

/* Time of one pass of the plan, summed over its repetitions. */
struct ui_pass_times_row {
    char name[64]; /* copy, truncated */
    uint32_t repetition_count;
    double milliseconds; /* running mean */
};

struct ui_pass_times {
    struct ui_pass_times_row rows[UI_PASS_TIMES_ROW_COUNT]; /* rows of the newest plan */
    uint32_t row_count;
    uint64_t start;                          /* rg_times.start of the newest frame */
    float frames[UI_PASS_TIMES_FRAME_COUNT]; /* ring buffer of sums, milliseconds */
    uint32_t frame_count;                    /* frames recorded in total */
};

/* Adds the pass times of a frame. Ignores missing times and times that are already added. If the
 * plan has changed, restarts the means but keeps the history. */
void ui_pass_times_add(struct ui_pass_times *times, const struct rg_plan *plan,
                       const struct rg_times *frame);

double ui_pass_times_sum(const struct ui_pass_times *times); /* milliseconds */

/* Draws the panel; `what` names the measured plan. */
void ui_pass_times_panel(const char *what, const struct ui_pass_times *times);

#endif
