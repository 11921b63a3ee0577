/*
 * statistics.h: timing statistics: summaries, outliers, significance tests, power-law fits. Samples
 * must be finite. No function allocates memory. Quantiles are interpolated linearly (type 7 of R.
 * J. Hyndman, Y. Fan, Sample Quantiles in Statistical Packages, 1996).
 */
#ifndef FIRN_LAB_PROFILE_STATISTICS_H
#define FIRN_LAB_PROFILE_STATISTICS_H

#include <stdbool.h>
#include <stdint.h>

/* Summary statistics of samples. They are all 0 for an empty set. */
struct profile_summary {
    double mean;
    double sigma; /* standard deviation, divisor n - 1 */
    double min, median, p95, max;
};

struct profile_summary profile_summarize(const double *samples, uint32_t count);

/* Returns a quantile of one or more samples. `portion` 0 is the minimum, 0.5 the median. */
double profile_quantile(const double *samples, uint32_t count, double portion);

/* Limits beyond which a sample is an outlier. They lie 1.5 interquartile ranges below the lower
 * quartile and above the upper quartile (J. W. Tukey, Exploratory Data Analysis, 1977). */
struct profile_fences {
    double low, high;
};

struct profile_fences profile_fences(const double *samples, uint32_t count);

/* Sorts samples in ascending order, as struct profile_pair requires. */
void profile_sort(double *samples, uint32_t count);

/* Two non-empty sets of samples to compare, each in ascending order. */
struct profile_pair {
    const double *a, *b;
    uint32_t a_count, b_count;
};

/*
 * Returns the p-value of the two-sided Mann-Whitney U test: the probability of a difference at
 * least this large if both sets had the same distribution, which need not be normal (timings are
 * not). It is exact for up to PROFILE_EXACT_COUNT samples each without ties, else a normal
 * approximation corrected for ties and continuity (H. B. Mann, D. R. Whitney, On a Test of Whether
 * one of Two Random Variables is Stochastically Larger than the Other, 1947). Samples must be
 * independent, which thermal throttling violates.
 */
double profile_mann_whitney(const struct profile_pair *pair);

/* Returns the minimum p-value possible in profile_mann_whitney() with these sample counts. */
double profile_mann_whitney_min(uint32_t a_count, uint32_t b_count);

enum {
    PROFILE_EXACT_COUNT = 20
};

/*
 * Adjusts the p-values of `count` simultaneous tests by Holm's method. This method keeps the
 * probability of any false positive below the significance level (S. Holm, A Simple Sequentially
 * Rejective Multiple Test Procedure, 1979). `adjusted` must not alias `p`.
 */
void profile_holm(const double *p, double *adjusted, uint32_t count);

/* Ratio b / a with its 99 % confidence interval. All are 0 if any sample is not positive. */
struct profile_ratio {
    double low, ratio, high;
};

/* Estimates the ratio b / a as the median of all pairwise ratios, which outliers hardly affect. Its
 * logarithm is the Hodges-Lehmann shift of the logarithms (J. L. Hodges, E. L. Lehmann, Estimates
 * of Location Based on Rank Tests, 1963). If samples are few, the interval spans all ratios. */
struct profile_ratio profile_ratio(const struct profile_pair *pair);

/* Power law y = factor * x ^ exponent, by a least-squares fit of the logarithms. */
struct profile_fit {
    double exponent, factor;
    double r2;            /* r^2 of the logarithms */
    uint32_t point_count; /* points with x above 0 */
};

/* Fits a power law to the points with positive x. Returns zeros if one of these points has y <= 0,
 * or if all of them have equal x. */
struct profile_fit profile_fit(const double *x, const double *y, uint32_t count);

#endif
