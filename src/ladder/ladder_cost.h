/* ladder_cost.h: measures the frame time of several renderers alternately. */
#ifndef FIRN_LADDER_LADDER_COST_H
#define FIRN_LADDER_LADDER_COST_H

#include "src/render/renderer.h"

struct ladder_cost_request {
    const struct renderer_params *renderers; /* `keep` is set in copies of them */
    uint32_t count;                          /* of renderers */
    uint32_t run_count;                      /* timed runs, from 1, after one of warm-up */
    struct renderer_shot shot;
};

/*
 * Draws the shot with every renderer, one after another, run_count times, and measures the time
 * from the call to the end on the device, without readback. costs[i] becomes the median of renderer
 * i, milliseconds. Renderers alternate, so that other load of the machine affects all equally.
 */
MUST_USE enum status ladder_cost(const struct ladder_cost_request *request, double *costs,
                                 renderer_progress_fn *progress, void *user);

#endif
