/* difference.h: differences of the values of a layer in two images. */
#ifndef FIRN_METRIC_DIFFERENCE_H
#define FIRN_METRIC_DIFFERENCE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Sums over the planes that were added; initialise it with {0}. */
struct difference {
    double absolutes; /* of values clipped to 0 and 1 */
    double squares, relative_squares;
    double largest;      /* |test - reference| */
    uint64_t count;      /* values in the sums */
    uint64_t not_finite; /* pairs in which one is NaN or infinite: they are not in the sums */
};

/* Adds a plane of `count` texels; `counted` selects the texels to add (NULL: all). */
void difference_add(struct difference *difference, const float *reference, const float *test,
                    const bool *counted, size_t count);

/* Returns the root of the mean square. This and the functions below return NaN if count is 0. */
double difference_rmse(const struct difference *difference);

/* Returns the mean of |test - reference|, both clipped to a display's range, 0 to 1. */
double difference_mae(const struct difference *difference);

/* Returns the mean of (test - reference)^2 / (reference^2 + 0.01). */
double difference_relmse(const struct difference *difference);

#endif
