/*
 * ui_times.h: what each pass takes, as bars, and over time: a column for each of the last frames.
 */
#ifndef FIRN_VIEW_UI_UI_TIMES_H
#define FIRN_VIEW_UI_UI_TIMES_H

#include "graph/rg_time.h"

enum {
    UI_TIMES_ROW_COUNT = 96,    /* more are left out */
    UI_TIMES_FRAME_COUNT = 120, /* older ones are forgotten */
};

/* A row of the frame's tables, with all its repetitions. */
struct ui_times_row {
    char name[64]; /* cut; the plan may be gone when it is shown */
    uint32_t repetition_count;
    double milliseconds; /* a running mean */
};

/* A frame. */
struct ui_times_frame {
    uint32_t row_count;
    float milliseconds[UI_TIMES_ROW_COUNT];
    uint32_t keys[UI_TIMES_ROW_COUNT]; /* ui_times_key() of the rows' names */
};

struct ui_times {
    struct ui_times_row rows[UI_TIMES_ROW_COUNT]; /* of the newest plan */
    uint32_t row_count;
    uint64_t start;                                     /* of the newest frame: rg_times.start */
    struct ui_times_frame frames[UI_TIMES_FRAME_COUNT]; /* frame n is at n modulo their count */
    uint32_t frame_count;                               /* ever */
};

/* The number by which a pass has its colour, whatever its plan. */
uint32_t ui_times_key(const char *name);

/* Takes a frame in; nothing if it was not measured, or has been taken. Means of another plan's rows
 * begin anew; frames stay. */
void ui_times_add(struct ui_times *times, const struct rg_plan *plan, const struct rg_times *frame);

double ui_times_sum(const struct ui_times *times); /* milliseconds */

/* Milliseconds of a frame's passes; `ago` 0: the newest. Below 0: there is none. */
double ui_times_frame(const struct ui_times *times, uint32_t ago);

/* `what`: whose times they are. */
void ui_times_panel(const char *what, const struct ui_times *times);

#endif
