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

/* Recorded times of one frame. */
struct ui_pass_times_frame {
    uint32_t row_count;
    float milliseconds[UI_PASS_TIMES_ROW_COUNT];
    uint32_t keys[UI_PASS_TIMES_ROW_COUNT]; /* ui_pass_times_key() of the pass names */
};

struct ui_pass_times {
    struct ui_pass_times_row rows[UI_PASS_TIMES_ROW_COUNT]; /* rows of the newest plan */
    uint32_t row_count;
    uint64_t start; /* rg_times.start of the newest frame */
    /* ring buffer */
    struct ui_pass_times_frame frames[UI_PASS_TIMES_FRAME_COUNT];
    uint32_t frame_count; /* frames recorded in total */
};

/* Returns a hash of a pass name. A pass has the same hash, and thus colour, in all plans. */
uint32_t ui_pass_times_key(const char *name);

/* Adds the pass times of a frame. Ignores missing times and times that are already added. If the
 * plan has changed, restarts the means but keeps the history. */
void ui_pass_times_add(struct ui_pass_times *times, const struct rg_plan *plan,
                       const struct rg_times *frame);

double ui_pass_times_sum(const struct ui_pass_times *times); /* milliseconds */

/* Returns the GPU time of the frame `ago` frames before the newest, ms; negative if none. */
double ui_pass_times_frame(const struct ui_pass_times *times, uint32_t ago);

/* Draws the panel; `what` names the measured plan. */
void ui_pass_times_panel(const char *what, const struct ui_pass_times *times);

#endif
