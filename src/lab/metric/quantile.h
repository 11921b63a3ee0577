/* quantile.h: median and quantiles of float arrays without NaN. */
#ifndef FIRN_LAB_METRIC_QUANTILE_H
#define FIRN_LAB_METRIC_QUANTILE_H

#include <stddef.h>

/* Sorts values in ascending order, as quantile_median() and quantile_at() require. */
void quantile_sort(float *values, size_t count);

/* Returns the median of sorted values; `count` must be at least 1. */
double quantile_median(const float *sorted, size_t count);

/* Returns the smallest value v such that at least a `fraction` (0 to 1) of all values are <= v. */
double quantile_at(const float *sorted, size_t count, double fraction);

#endif
