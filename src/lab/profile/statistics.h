/*
 * statistics.h: timing statistics: summaries and a significance test. Samples must be finite. No
 * function allocates memory. Quantiles are interpolated linearly (type 7 of R. J. Hyndman, Y. Fan,
 * Sample Quantiles in Statistical Packages, 1996).
 */
#ifndef FIRN_LAB_PROFILE_STATISTICS_H
#define FIRN_LAB_PROFILE_STATISTICS_H

#include <stdint.h>

/* Summary statistics of samples. They are all 0 for an empty set. */
struct profile_summary {
    double mean;
    double sigma; /* standard deviation, divisor n - 1 */
    double min, median, p95, max;
};

struct profile_summary profile_summarize(const double *samples, uint32_t count);

/* Two non-empty sets of samples to compare, each in ascending order. */
struct profile_pair {
    const double *a, *b;
    uint32_t a_count, b_count;
};

/*
 * Returns the p-value of the two-sided Mann-Whitney U test: the probability of a difference at
 * least this large if both sets had the same distribution, which need not be normal (timings are
 * not). Uses the normal approximation with continuity correction (H. B. Mann, D. R. Whitney, On a
 * Test of Whether one of Two Random Variables is Stochastically Larger than the Other, 1947). Ties
 * make the value too large. Samples must be independent, which thermal throttling violates.
 */
double profile_mann_whitney(const struct profile_pair *pair);

/* Returns the minimum p-value possible in profile_mann_whitney() with these sample counts. */
double profile_mann_whitney_min(uint32_t a_count, uint32_t b_count);

#endif
