/*
 * measure.h: draws a frame again and again, and says what each pass of it cost.
 *
 * Every run draws the frame of its moment twice, once with nothing measured and once measured, in
 * turns of which comes first. Nothing is copied back: the picture stays on the device.
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
    /* gpu, scene, settings, rung, width, height, sharing count */
    struct renderer_params renderer;
    struct camera camera;
    const struct profile_clock *clock;
    uint32_t warmup, run_count; /* run_count from 1 */
    char *capture; /* not NULL: RenderDoc, which is there, captures a frame, and its file's path
                      comes here, MEASURE_PATH_SIZE bytes */
    double time, time_step; /* seconds: of the warm-up and the first run; from run to run */
};

/* Called after every run, those of the warm-up included; false stops with STATUS_FAILED, nothing
 * logged. May be NULL. */
typedef bool profile_progress_fn(void *user, uint32_t done, uint32_t all);

/*
 * Makes a renderer, draws, and fills all of *profile but command, scene, material and settings,
 * which are the caller's to know. On failure *profile is {0}.
 */
MUST_USE enum status profile_measure(struct profile *profile, const struct profile_request *request,
                                     profile_progress_fn *progress, void *user);

#endif
