/* angle.h: angles between the directions that a layer stores in two images. */
#ifndef FIRN_METRIC_ANGLE_H
#define FIRN_METRIC_ANGLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A direction layer of both images. Pixels have a direction if it is finite and longer than 0.5. */
struct angle_pair {
    const float *reference[3], *test[3];
    const bool *counted; /* mask of the pixels to measure; NULL for all */
    size_t pixel_count;
};

struct angle {
    uint64_t both, only_reference, only_test; /* pixels with directions in both images; in one */
    double mean, median, percentile_95,
        largest; /* degrees, over the pixels in `both`; NaN if none */
};

/* Returns true if a pixel has a direction. */
bool angle_is_there(const float *const direction[static 3], size_t pixel);

/*
 * Measures the angles of all pixels in the mask. degrees[] (pixel_count elements; may be NULL)
 * receives the angles, 0 where a direction is missing. Returns false when out of memory.
 */
bool angle_measure(struct angle *angle, const struct angle_pair *pair, float *degrees);

#endif
