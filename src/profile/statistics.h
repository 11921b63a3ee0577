/*
 * statistics.h: timing statistics: summaries, outliers, significance tests, power-law fits.
 *
 * Samples must be finite. Nothing here allocates. Quantiles are interpolated linearly between
 * samples (type 7 of R. J. Hyndman, Y. Fan, Sample Quantiles in Statistical Packages, 1996).
 */
#ifndef FIRN_PROFILE_STATISTICS_H
#define FIRN_PROFILE_STATISTICS_H

#include <stdbool.h>
#include <stdint.h>

/* Summary of a set of samples; all 0 for an empty set. */
struct profile_summary {
    double mean;
    double sigma; /* sample standard deviation with divisor n - 1; 0 for a single sample */
    double min, median, p95, max;
};

struct profile_summary profile_summarize(const double *samples, uint32_t count);

/* Returns a quantile of at least one sample: `portion` is 0 for the minimum, 0.5 for the median. */
double profile_quantile(const double *samples, uint32_t count, double portion);

/* Limits beyond which a sample is an outlier: 1.5 interquartile ranges outside the quartiles (J. W.
 * Tukey, Exploratory Data Analysis, 1977). */
struct profile_fences {
    double low, high;
};

struct profile_fences profile_fences(const double *samples, uint32_t count);

/* Sorts samples in ascending order, as the functions of struct profile_pair require. */
void profile_sort(double *samples, uint32_t count);

/* Two non-empty sets of samples, each in ascending order. */
struct profile_pair {
    const double *a, *b;
    uint32_t a_count, b_count;
};

/*
 * Returns the p-value of the two-sided Mann-Whitney U test: the probability of a difference at
 * least this large if both sets had the same distribution. The test assumes no normal distribution,
 * which timings do not have. It is exact for up to PROFILE_EXACT_COUNT samples each without ties,
 * else a normal approximation with corrections for ties and continuity (H. B. Mann, D. R. Whitney,
 * On a Test of Whether one of Two Random Variables is Stochastically Larger than the Other, 1947).
 * Samples must be independent, which thermal throttling violates.
 */
double profile_mann_whitney(const struct profile_pair *pair);

/* Returns the smallest p-value that profile_mann_whitney() can yield with these sample counts. */
double profile_mann_whitney_least(uint32_t a_count, uint32_t b_count);

enum {
    PROFILE_EXACT_COUNT = 20
};

/*
 * Adjusts the p-values of `count` simultaneous tests by Holm's method, so that the probability of
 * any false positive stays below the significance level (S. Holm, A Simple Sequentially Rejective
 * Multiple Test Procedure, 1979). `adjusted` must not alias `p`.
 */
void profile_holm(const double *p, double *adjusted, uint32_t count);

/* Ratio b / a with a 99 % confidence interval; all 0 if a sample is not positive. */
struct profile_ratio {
    double low, ratio, high;
};

/* Estimates the ratio b / a as the median of all pairwise ratios, which is the Hodges-Lehmann shift
 * of the logarithms (J. L. Hodges, E. L. Lehmann, Estimates of Location Based on Rank Tests, 1963)
 * and robust against outliers. With few samples the interval spans all ratios. */
struct profile_ratio profile_ratio(const struct profile_pair *pair);

/* A power law y = factor * x ^ exponent, by a least-squares fit of the logarithms. */
struct profile_fit {
    double exponent, factor;
    double r2;            /* coefficient of determination of the logarithms; 1 if all y are equal */
    uint32_t point_count; /* number of points with x above 0; 0 if there is no fit */
};

/* Fits a power law to the points with x above 0. There is no fit if all x are equal, or if one of
 * these points has a y that is not positive. */
struct profile_fit profile_fit(const double *x, const double *y, uint32_t count);

#endif
