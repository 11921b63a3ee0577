/* angle.h: angles between directions stored in a layer of two images. */
#ifndef FIRN_METRIC_ANGLE_H
#define FIRN_METRIC_ANGLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Direction layer of two images. A pixel has a direction if it is finite and longer than 0.5. */
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
 * Measures the angles of all pixels in the mask. degrees[], pixel_count elements or NULL, receives
 * the angles, 0 where a direction is missing. Returns false when out of memory.
 */
bool angle_measure(struct angle *angle, const struct angle_pair *pair, float *degrees);

#endif
