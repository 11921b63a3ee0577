/*
 * measure.h: renders a frame repeatedly and measures its passes.
 *
 * Each run renders the frame twice, once with measurement of each pass and once without; their
 * order alternates. The difference is the measurement overhead. There is no readback: the image
 * stays on the GPU.
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
    /* Only these members are used: gpu, scene, settings, rung, width, height, sharing. */
    struct renderer_params renderer;
    struct camera camera;
    const struct profile_clock *clock;
    uint32_t warmup, run_count; /* warm-up runs; measured runs, at least 1 */
    char *capture; /* NULL, or MEASURE_PATH_SIZE bytes for the path of a RenderDoc capture */
    double time, time_step; /* seconds: scene time of the first run; time step per run */
};

/* Called after each run, warm-up included. Returns false to stop with STATUS_FAILED, without a log.
 */
typedef bool profile_progress_fn(void *user, uint32_t done, uint32_t all);

/* Profiles that are measured together. */
struct profile_run {
    const struct profile_request *requests; /* all with the same `warmup` and `run_count` */
    struct profile *profiles;               /* receive the results */
    uint32_t count;                         /* number of requests and profiles, at least 1 */
    profile_progress_fn *progress;          /* may be NULL; counts the runs of all profiles */
    void *user;
};

/*
 * Creates a renderer for each request and fills the profiles. Runs are interleaved between the
 * renderers, so that other load on the machine affects all of them equally. The caller fills
 * command, scene, material and settings. On failure all profiles are {0}.
 */
MUST_USE enum status profile_measure(const struct profile_run *run);

#endif
