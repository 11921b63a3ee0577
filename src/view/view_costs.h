/*
 * view_costs.h: where the time of frames goes.
 *
 *     view_costs_rest()     what was no frame: files, other settings, a pause
 *     view_costs_limit()    waiting for --fps-limit
 *     view_costs_frame()    a frame has been handed to the screen
 *
 * A frame takes from the end of the one before to its own. What is left of it after the passes on
 * the device and the host's own work are waits: until the screen takes the picture.
 */
#ifndef FIRN_VIEW_VIEW_COSTS_H
#define FIRN_VIEW_VIEW_COSTS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include "graph/rg_time.h"
#include "src/view/ui/ui_pace.h"

enum {
    VIEW_TIME_COUNT = 1024, /* of each kind; the newest */
};

/* Seconds that something took, again and again. */
struct view_times {
    float values[VIEW_TIME_COUNT];
    uint32_t count; /* ever */
};

/* Seconds. The sums leave out the first frame, which compiles shaders. */
struct view_costs {
    uint32_t frame_count;
    double end;                 /* of the frame before; 0: there is none to count from */
    double rest, limit;         /* since then */
    struct ui_pace last;        /* the newest frame; .frame 0: it says nothing */
    uint32_t counted;           /* frames in the sums: */
    double frames, passes;      /* passes: on the device */
    double host;                /* the host worked */
    struct view_times moving;   /* from picture to picture while something moves */
    struct view_times hand;     /* from a hand's movement until its picture has been handed over */
    struct view_times release;  /* from a hand's letting go to a picture in full size */
    double hand_at, release_at; /* what is waited for; 0: nothing */
};

void view_costs_rest(struct view_costs *costs, double start);  /* from `start` until now */
void view_costs_limit(struct view_costs *costs, double start); /* the same */

/* The frame before the next one does not count it: none was drawn for a while. */
void view_costs_pause(struct view_costs *costs);

/* `times`: of each plan that ran, as they were seen last; `screen`: seconds the host waited for the
 * screen. */
void view_costs_frame(struct view_costs *costs, const struct rg_times *times, uint32_t time_count,
                      double screen);

/* A hand moved, or let go, at a moment; what has not been seen yet counts from its first. */
void view_costs_hand(struct view_costs *costs, double moved, double released);

/* The frame that has just been counted shows another picture: of a movement, or in full size. */
void view_costs_picture(struct view_costs *costs, bool is_moving);

/* A line: frames, and the means of their parts; and one of movements, if there were any. */
void view_costs_print(const struct view_costs *costs, FILE *out);

#endif
