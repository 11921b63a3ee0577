/* angle.h: how far the directions of a layer are apart. */
#ifndef FIRN_METRIC_ANGLE_H
#define FIRN_METRIC_ANGLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A layer in both files. A pixel has a direction where X, Y, Z are finite and longer than 0.5. */
struct angle_pair {
    const float *reference[3], *test[3];
    const bool *counted; /* pixels that count; may be NULL: all */
    size_t pixel_count;
};

struct angle {
    uint64_t both, only_reference, only_test; /* pixels that have a direction in them */
    double mean, median, most_95, largest;    /* degrees, of `both`; NaN if there is none */
};

bool angle_is_there(const float *const direction[static 3], size_t pixel);

/*
 * Measures them. degrees[] (pixel_count; may be NULL) gets the angle of every pixel that counts, 0
 * where one has no direction. False: memory is short.
 */
bool angle_measure(struct angle *angle, const struct angle_pair *pair, float *degrees);

#endif
