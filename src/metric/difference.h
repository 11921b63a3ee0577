/* difference.h: how far the numbers of a layer are apart. */
#ifndef FIRN_METRIC_DIFFERENCE_H
#define FIRN_METRIC_DIFFERENCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Sums over the planes that were added, {0} at first. */
struct difference {
    double absolutes; /* of values clipped to 0 and 1 */
    double squares, relative_squares;
    double largest;      /* |test - reference| */
    uint64_t count;      /* values in the sums */
    uint64_t not_finite; /* pairs in which one is NaN or infinite: they are not in the sums */
};

/* `counted` (may be NULL: all) tells of each of the texels whether it counts. */
void difference_add(struct difference *difference, const float *reference, const float *test,
                    const bool *counted, size_t count);

/* Root of the mean square; NaN where nothing counts, as below. */
double difference_rmse(const struct difference *difference);

/* Mean of |test - reference|, both clipped to what a display shows: 0 to 1. */
double difference_mae(const struct difference *difference);

/* mean((test - reference)^2 / (reference^2 + 0.01)) */
double difference_relmse(const struct difference *difference);

#endif
