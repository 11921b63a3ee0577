/* error_sums.h: error metrics between two image layers: RMSE, MAE, relMSE. */
#ifndef FIRN_LAB_METRIC_ERROR_SUMS_H
#define FIRN_LAB_METRIC_ERROR_SUMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Error sums over all planes added so far. Initialise them with {0}. */
struct difference {
    double clipped_absolutes; /* of values clamped to 0..1 */
    double absolutes;
    double squares, relative_squares;
    double largest;      /* maximum of |test - reference| */
    uint64_t count;      /* pairs of values in the sums */
    uint64_t not_finite; /* excluded pairs with NaN or infinity */
};

/* Adds a plane of `count` texels. If `counted` is not NULL, it masks the texels to add. */
void difference_add(struct difference *difference, const float *reference, const float *test,
                    const bool *counted, size_t count);

/* Returns the root mean square error, or NaN if no values were added. */
double difference_rmse(const struct difference *difference);

/* Returns the clipped MAE: the mean of |test - reference|, where both are first clamped to 0..1. */
double difference_mae(const struct difference *difference);

/* Returns the unclipped MAE: the mean of |test - reference|. */
double difference_mae_unclipped(const struct difference *difference);

/* Returns relMSE: the mean of (test - reference)^2 / (reference^2 + 0.01). */
double difference_relmse(const struct difference *difference);

#endif
