/* angle.h: angles between directions stored in a layer of two images. */
#ifndef FIRN_LAB_METRIC_ANGLE_H
#define FIRN_LAB_METRIC_ANGLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Direction layer of two images. Vectors that are not finite, or shorter than 0.5, are ignored. */
struct angle_pair {
    const float *reference[3], *test[3];
    const bool *counted; /* mask of pixels; NULL for all */
    size_t pixel_count;
};

struct angle {
    uint64_t both, only_reference, only_test;    /* directions in both; in one only */
    double mean, median, percentile_95, largest; /* degrees over `both`; NaN if none */
};

/* Returns true if a pixel has a direction. */
bool angle_is_there(const float *const direction[static 3], size_t pixel);

/*
 * Measures the angle between both images at each pixel in the mask. If `degrees` is not NULL, it
 * receives pixel_count angles, 0 where an image has no direction. Returns false if out of memory.
 */
bool angle_measure(struct angle *angle, const struct angle_pair *pair, float *degrees);

#endif
