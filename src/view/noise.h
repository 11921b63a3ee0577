/*
 * noise.h: how uncertain the mean of a picture's samples still is.
 *
 * The picture is looked at in blocks of 8x8 pixels: the standard error of a block's mean over the
 * samples so far, as if they were independent; the noise is the mean of all blocks' errors.
 */
#ifndef FIRN_VIEW_NOISE_H
#define FIRN_VIEW_NOISE_H

#include "src/image/image.h"

enum {
    NOISE_BLOCK = 8, /* pixels, each way */
};

struct noise {
    uint32_t columns, rows; /* of blocks; 0: nothing has been added */
    double *blocks;         /* for each the sum, and that of the samples' squares */
    uint32_t count;         /* samples */
};

void noise_finish(struct noise *noise); /* {0} is fine */

/* Adds the sample that made the sums (planes R, G, B) what they are; sample 0 begins anew. Without
 * memory there is no noise. */
void noise_add(struct noise *noise, const struct image *sums, uint32_t sample);

/* In units of the picture's colours; below 0: it is not known, of less than two samples. */
double noise_now(const struct noise *noise);

#endif
