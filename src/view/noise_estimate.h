/* noise_estimate.h: standard error of a progressively refined image. Each sample gives one mean per
 * block of 8x8 pixels. The variance of these means gives the block's standard error. The estimate
 * is the mean error of all blocks. It assumes independent samples. */
#ifndef FIRN_VIEW_NOISE_ESTIMATE_H
#define FIRN_VIEW_NOISE_ESTIMATE_H

#include "src/file/image.h"

enum {
    NOISE_ESTIMATE_BLOCK = 8, /* width and height of a block, pixels */
};

struct noise_estimate {
    uint32_t columns, rows; /* number of blocks; 0 if empty */
    double *blocks;         /* sums over samples of each block's mean and squared mean */
    uint32_t count;         /* samples added so far */
};

void noise_estimate_finish(struct noise_estimate *noise); /* {0} is fine */

/* Adds sample number `sample` to the estimate. Number 0 restarts the estimate. `sums` contains the
 * accumulated planes R, G and B. If out of memory, makes noise_estimate_now() return -1. */
void noise_estimate_add(struct noise_estimate *noise, const struct image *sums, uint32_t sample);

/* Returns the standard error in the image's units. Returns -1 with fewer than two samples. */
double noise_estimate_now(const struct noise_estimate *noise);

#endif
