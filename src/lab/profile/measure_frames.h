/*
 * measure_frames.h: renders a frame repeatedly and measures its passes. Each run renders the frame
 * once with and once without measurement of passes, in alternating order. The time difference is
 * the measurement overhead. The image is not read back from the GPU.
 */
#ifndef FIRN_LAB_PROFILE_MEASURE_FRAMES_H
#define FIRN_LAB_PROFILE_MEASURE_FRAMES_H

#include "graph/rg_profile.h"
#include "src/lab/profile/profile_data.h"
#include "src/render/renderer.h"

enum {
    MEASURE_PATH_SIZE = 1024
};

struct profile_request {
    /* Parameters of the renderer, except samples, layers, linear, display, keep and measured, whose
     * values are ignored. */
    struct renderer_params renderer;
    struct camera camera;
    enum rg_clock clock;        /* RG_CLOCK_EXACT or RG_CLOCK_SUBMITS */
    uint32_t warmup, run_count; /* `run_count` must be at least 1 */
    char *capture;              /* path, MEASURE_PATH_SIZE bytes, or NULL */
    double time, time_step;     /* seconds: first run's scene time, step */
};

/* Callback after each run or warm-up run. */
typedef void profile_progress_fn(void *user, uint32_t done, uint32_t all);

/* Creates a renderer and fills the profile. Leaves command, scene, material and settings for the
 * caller to fill in. On failure the profile is zeroed. */
MUST_USE enum status profile_measure(const struct profile_request *request, struct profile *profile,
                                     profile_progress_fn *progress, void *user);

#endif
