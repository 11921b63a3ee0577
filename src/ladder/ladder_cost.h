/* ladder_cost.h: what a frame of each of several renderers costs, in turns. */
#ifndef FIRN_LADDER_LADDER_COST_H
#define FIRN_LADDER_LADDER_COST_H

#include "src/render/renderer.h"

struct ladder_cost_request {
    const struct renderer_params *renderers; /* keep is set for them */
    uint32_t count;                          /* of renderers */
    uint32_t run_count;                      /* from 1; one more, before them, does not count */
    struct renderer_shot shot;
};

/*
 * Draws the shot with every renderer, one after another, run_count times, and takes the time from
 * the call to the end on the device, with nothing copied back. costs[i] gets the median of a
 * renderer, milliseconds. Alternating, so that whatever else the machine does hits all alike.
 */
MUST_USE enum status ladder_cost(const struct ladder_cost_request *request, double *costs,
                                 renderer_progress_fn *progress, void *user);

#endif
