/*
 * view_frame_stats.h: statistics of frame times and input latency.
 *
 *     view_frame_stats_exclude()  excludes time outside frames: loading, changed settings, pauses
 *     view_frame_stats_end()      ends a frame, after it was presented
 *
 * A frame lasts from the end of the previous one to its own end. Its time minus GPU passes and host
 * work is spent waiting for the presentation engine.
 */
#ifndef FIRN_VIEW_VIEW_FRAME_STATS_H
#define FIRN_VIEW_VIEW_FRAME_STATS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include "graph/rg_profile.h"
#include "src/view/panels/ui_frame_bottleneck.h"

enum {
    VIEW_TIME_COUNT = 1024, /* capacity of a ring of times */
};

/* Ring buffer of repeated measurements, in seconds. */
struct view_time_ring {
    float values[VIEW_TIME_COUNT];
    uint32_t count; /* measurements in total */
};

/* Frame times in seconds. The sums omit the first frames, because shaders are compiled in them. */
struct view_frame_stats {
    uint32_t frame_count;
    double last_end;                          /* 0 if there is none */
    double idle;                              /* idle time since `last_end` */
    struct ui_frame_pacing last;              /* newest; .frame 0 if not measured */
    uint32_t summed_count;                    /* frames in the sums below */
    double frames, passes;                    /* passes: GPU time */
    double host;                              /* time in which the host worked */
    struct view_time_ring interactive_frames; /* between images while something moves */
    struct view_time_ring drag_latency;     /* latency from mouse movement to the presented image */
    struct view_time_ring release_latency;  /* latency from mouse release to the full-size image */
    struct view_time_ring complete_latency; /* latency from mouse release to the first sample */
    struct view_time_ring stretches;        /* CPU time of all threads between two polls of input */
    double longest;                         /* of these, seconds */
    double polled_cpu;                      /* CPU time at the last poll; 0 before the first one */
    double ended_at; /* time of the release whose complete_latency is pending; or 0 */
    double dragged_at, released_at; /* pending latency measurements; 0 if none */
};

/* Excludes the time since `start` from the frame time. */
void view_frame_stats_exclude(struct view_frame_stats *c, double start);

/* Excludes the time until the next frame, since nothing was drawn for a while. */
void view_frame_stats_pause(struct view_frame_stats *c);

/* Ends a frame. `times` are the newest GPU times, one per plan; `presentation` is in seconds. */
void view_frame_stats_end(struct view_frame_stats *c, const struct rg_times *times,
                          uint32_t time_count, double presentation);

/* Starts latency measurements at the time of a mouse movement or release, seconds; 0 means none. */
void view_frame_stats_input(struct view_frame_stats *c, double moved, double released);

/* Records that the last frame showed a new image. `is_moving` is true for interactive images. */
void view_frame_stats_image(struct view_frame_stats *c, bool is_moving);

/* Records that the last frame showed a sample of full quality. */
void view_frame_stats_sample(struct view_frame_stats *c);

/* Records that input was polled. `refines`: a part of a sample was drawn since the last poll. */
void view_frame_stats_poll(struct view_frame_stats *c, bool refines);

/* Prints the number of frames and mean times, and interaction times if there were any. */
void view_frame_stats_print(const struct view_frame_stats *c, FILE *out);

#endif
