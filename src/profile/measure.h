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

/* What is measured together. */
struct profile_run {
    const struct profile_request *requests; /* with equal `warmup` and `run_count` */
    struct profile *profiles;               /* for the results */
    uint32_t count;                         /* of both; from 1 */
    profile_progress_fn *progress;          /* may be NULL; counts the runs of all */
    void *user;
};

/*
 * Creates a renderer for each request, draws each run by all renderers, one after another, so that
 * other load of the machine affects all equally, and fills the profiles, except for command, scene,
 * material and settings, which the caller fills. On failure all profiles are {0}.
 */
MUST_USE enum status profile_measure(const struct profile_run *run);

#endif
