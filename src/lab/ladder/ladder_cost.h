/* ladder_cost.h: measures the frame times of several renderers alternately. */
#ifndef FIRN_LAB_LADDER_LADDER_COST_H
#define FIRN_LAB_LADDER_LADDER_COST_H

#include "src/render/renderer.h"

struct ladder_cost_request {
    const struct renderer_params *renderers; /* copied, with `keep` set */
    uint32_t count;                          /* number of renderers */
    uint32_t run_count;                      /* timed runs after a warm-up run */
    struct renderer_shot shot;
};

/*
 * Measures the frame time of each renderer, from the call until the GPU has finished. Reading the
 * image back is excluded. costs[i] is renderer i's median of run_count runs, in milliseconds. The
 * renderers take turns, because other load on the machine then affects all of them equally.
 */
MUST_USE enum status ladder_cost(const struct ladder_cost_request *request, double *costs,
                                 renderer_progress_fn *progress, void *user);

#endif
