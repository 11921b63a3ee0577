/*
 * statistics.h: what samples say: summaries, outliers, whether two sets differ, how cost grows.
 *
 * Samples are finite. Nothing here allocates. Quantiles are linear between two samples: type 7 of
 * R. J. Hyndman, Y. Fan, Sample Quantiles in Statistical Packages, 1996.
 */
#ifndef FIRN_PROFILE_STATISTICS_H
#define FIRN_PROFILE_STATISTICS_H

#include <stdbool.h>
#include <stdint.h>

/* All 0 of no samples. */
struct profile_summary {
    double mean;
    double sigma; /* of a sample: divided by n - 1; 0 of one */
    double min, median, p95, max;
};

struct profile_summary profile_summarize(const double *samples, uint32_t count);

/* `portion` 0 is the least, 0.5 the median, 1 the greatest. There is at least one sample. */
double profile_quantile(const double *samples, uint32_t count, double portion);

/* What lies outside is an outlier: 1.5 interquartile ranges beyond the quartiles (J. W. Tukey,
 * Exploratory Data Analysis, 1977). */
struct profile_fences {
    double low, high;
};

struct profile_fences profile_fences(const double *samples, uint32_t count);

/* The functions of two sets want samples in ascending order. */
void profile_sort(double *samples, uint32_t count);

/* Of two sets, in ascending order, none of them empty. */
struct profile_pair {
    const double *a, *b;
    uint32_t a_count, b_count;
};

/*
 * The probability of two sets as different as these, or more, if both came from one source:
 * two-sided Mann-Whitney U test. Exact for up to PROFILE_EXACT_COUNT samples each, all different;
 * else by the normal distribution, corrected for ties and for continuity. (H. B. Mann,
 * D. R. Whitney, On a Test of Whether one of Two Random Variables is Stochastically Larger than
 * the Other, 1947.) It takes samples for independent: a machine that slowly gets hot fools it.
 */
double profile_mann_whitney(const struct profile_pair *pair);

/* The least that profile_mann_whitney() can return for so many samples. */
double profile_mann_whitney_least(uint32_t a_count, uint32_t b_count);

enum {
    PROFILE_EXACT_COUNT = 20
};

/*
 * Of `count` tests at once: p as if there were one, so that below a level the chance of any false
 * alarm is at most that level. (S. Holm, A Simple Sequentially Rejective Multiple Test Procedure,
 * 1979.) `adjusted` may not be `p`.
 */
void profile_holm(const double *p, double *adjusted, uint32_t count);

/* How many times b is a. 0 where a sample is not above 0. */
struct profile_ratio {
    double low, ratio, high;
};

/* The median of all quotients b / a, and an interval that holds the true one with 99 %: the shift
 * of J. L. Hodges, E. L. Lehmann, Estimates of Location Based on Rank Tests, 1963, of logarithms.
 * With few samples the interval is from the least to the greatest quotient. */
struct profile_ratio profile_ratio(const struct profile_pair *pair);

/* y = factor * x ^ exponent, by least squares in the logarithms. */
struct profile_fit {
    double exponent, factor;
    double r2; /* the part of the variance (of logarithms) that it explains; 1 if there is none */
    uint32_t point_count; /* used: those with x above 0; 0: there is no fit */
};

/* No fit where fewer than two x differ, or where a y of a used point is not above 0. */
struct profile_fit profile_fit(const double *x, const double *y, uint32_t count);

#endif
