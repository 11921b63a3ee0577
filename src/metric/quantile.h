/* quantile.h: what stands where in a list of numbers. None may be NaN. */
#ifndef FIRN_METRIC_QUANTILE_H
#define FIRN_METRIC_QUANTILE_H

#include <stddef.h>

void quantile_sort(float *values, size_t count);

/* Of sorted values, at least one: the middle one, or the mean of the two in the middle. */
double quantile_median(const float *sorted, size_t count);

/* The least of them that a share (0 to 1) of all does not exceed. */
double quantile_at(const float *sorted, size_t count, double share);

#endif
