/* quantile.h: quantiles of lists of numbers, none of which may be NaN. */
#ifndef FIRN_METRIC_QUANTILE_H
#define FIRN_METRIC_QUANTILE_H

#include <stddef.h>

/* Sorts in ascending order. */
void quantile_sort(float *values, size_t count);

/* Returns the median of at least one sorted value. */
double quantile_median(const float *sorted, size_t count);

/* Returns the least of the sorted values that a share (0 to 1) of all does not exceed. */
double quantile_at(const float *sorted, size_t count, double share);

#endif
