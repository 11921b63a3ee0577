/* angle.h: angles between the directions of a layer in two images. */
#ifndef FIRN_METRIC_ANGLE_H
#define FIRN_METRIC_ANGLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A layer in both images. A pixel has a direction if X, Y, Z are finite and its length is above
 * 0.5. */
struct angle_pair {
    const float *reference[3], *test[3];
    const bool *counted; /* pixels to measure; NULL: all */
    size_t pixel_count;
};

struct angle {
    uint64_t both, only_reference, only_test; /* pixels that have a direction in these images */
    double mean, median, most_95, largest;    /* degrees, of `both`; NaN if that is 0 */
};

/* Returns whether a pixel has a direction. */
bool angle_is_there(const float *const direction[static 3], size_t pixel);

/*
 * Measures the angles. degrees[] (pixel_count elements; may be NULL) receives the angle of every
 * counted pixel, 0 where a direction is missing. Returns false when out of memory.
 */
bool angle_measure(struct angle *angle, const struct angle_pair *pair, float *degrees);

#endif
