/*
 * measure.h: draws a frame repeatedly and measures its passes.
 *
 * Every run draws the frame of its time twice, once measured and once not; which of them is first
 * alternates. There is no readback: the picture stays on the device.
 */
#ifndef FIRN_PROFILE_MEASURE_H
#define FIRN_PROFILE_MEASURE_H

#include "src/profile/profile.h"
#include "src/profile/timestamp_check.h"
#include "src/render/renderer.h"

enum {
    MEASURE_PATH_SIZE = 1024
};

struct profile_request {
    /* Only gpu, scene, settings, rung, width, height and sharing are used. */
    struct renderer_params renderer;
    struct camera camera;
    const struct profile_clock *clock;
    uint32_t warmup, run_count; /* warm-up runs; measured runs, from 1 */
    char *capture; /* NULL, or MEASURE_PATH_SIZE bytes for the path of a file in which RenderDoc,
                      which must be loaded, captures a frame */
    double time, time_step; /* seconds: time of the first run; from run to run */
};

/* Called after every run, including the warm-up. If it returns false, measuring stops with
 * STATUS_FAILED and logs nothing. */
typedef bool profile_progress_fn(void *user, uint32_t done, uint32_t all);

/*
 * Creates a renderer, draws, and fills *profile, except for command, scene, material and settings,
 * which the caller fills. `progress` may be NULL. On failure *profile is {0}.
 */
MUST_USE enum status profile_measure(struct profile *profile, const struct profile_request *request,
                                     profile_progress_fn *progress, void *user);

#endif
