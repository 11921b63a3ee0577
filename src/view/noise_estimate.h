/*
 * noise_estimate.h: estimates the standard error of a progressively refined image.
 *
 * The image is divided into blocks of 8x8 pixels. For each block, the standard error of its mean is
 * computed from the variance over samples, treated as independent; the estimate is the mean over
 * all blocks.
 */
#ifndef FIRN_VIEW_NOISE_ESTIMATE_H
#define FIRN_VIEW_NOISE_ESTIMATE_H

#include "src/image/image.h"

enum {
    NOISE_ESTIMATE_BLOCK = 8, /* width and height of a block, pixels */
};

struct noise_estimate {
    uint32_t columns, rows; /* number of blocks; 0 if nothing has been added */
    double *blocks;         /* per block: the sum of the samples, and the sum of their squares */
    uint32_t count;         /* samples added so far */
};

void noise_estimate_finish(struct noise_estimate *noise); /* {0} is fine */

/* Adds sample number `sample`, after which the accumulated planes R, G and B have the values
 * `sums`; sample 0 restarts the estimate. Without memory there is no estimate. */
void noise_estimate_add(struct noise_estimate *noise, const struct image *sums, uint32_t sample);

/* Returns the standard error in the image's units; negative with fewer than two samples. */
double noise_estimate_now(const struct noise_estimate *noise);

#endif
