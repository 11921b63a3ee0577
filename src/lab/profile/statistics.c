/* statistics.c: quantiles, Mann-Whitney test, Holm's method, Hodges-Lehmann ratio, power laws. */
#include "src/lab/profile/statistics.h"
#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Converts a 64-bit key back to its double. Keys sort like the doubles that they encode. */
static double from_key(uint64_t key)
{
    const uint64_t sign = UINT64_C(1) << 63;
    const uint64_t bits = key & sign ? key ^ sign : ~key;
    double value;
    memcpy(&value, &bits, sizeof(value));
    return value;
}

/* Callback that returns how many items are at most `value`. */
typedef uint64_t count_fn(const void *items, double value);

/* Returns item `index` in ascending order, by bisection over the bits of a double. Only counts
 * items and does not store them, so items can be all pairs of values from two sets. */
static double find_nth(count_fn *count, const void *items, uint64_t index)
{
    uint64_t key = 0;
    for (int bit = 63; bit >= 0; bit--) {
        const double value = from_key((key | UINT64_C(1) << bit) - 1);
        /* Keys beyond the infinities encode NaN. */
        const bool is_above = isnan(value) ? !signbit(value) : count(items, value) > index;
        if (!is_above)
            key |= UINT64_C(1) << bit;
    }
    return from_key(key) + 0.0; /* turns -0 into 0 */
}

struct samples {
    const double *values;
    uint32_t count;
};

static uint64_t count_samples(const void *items, double value)
{
    const struct samples *samples = items;
    uint64_t count = 0;
    for (uint32_t i = 0; i < samples->count; i++)
        count += samples->values[i] <= value;
    return count;
}

double profile_quantile(const double *samples, uint32_t count, double portion)
{
    assert(count > 0 && portion >= 0 && portion <= 1);
    const struct samples all = { samples, count };
    const double place = portion * (count - 1);
    const uint64_t index = (uint64_t)place;
    const double below = find_nth(count_samples, &all, index);
    if (place <= (double)index)
        return below;
    const double above = find_nth(count_samples, &all, index + 1);
    return below + (above - below) * (place - (double)index);
}

struct profile_summary profile_summarize(const double *samples, uint32_t count)
{
    if (count == 0)
        return (struct profile_summary){ 0 };

    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < count; i++)
        sum += samples[i];
    const double mean = sum / count;
    for (uint32_t i = 0; i < count; i++)
        squares += (samples[i] - mean) * (samples[i] - mean);
    return (struct profile_summary){
        .mean = mean,
        .sigma = count > 1 ? sqrt(squares / (count - 1)) : 0,
        .min = profile_quantile(samples, count, 0),
        .median = profile_quantile(samples, count, 0.5),
        .p95 = profile_quantile(samples, count, 0.95),
        .max = profile_quantile(samples, count, 1),
    };
}

struct profile_fences profile_fences(const double *samples, uint32_t count)
{
    const double lower = profile_quantile(samples, count, 0.25);
    const double upper = profile_quantile(samples, count, 0.75);
    const double whisker = 1.5 * (upper - lower);
    return (struct profile_fences){ lower - whisker, upper + whisker };
}

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void profile_sort(double *samples, uint32_t count)
{
    qsort(samples, count, sizeof(*samples), compare_numbers);
}

/* Mann-Whitney U statistic and the tie term of its variance. */
struct ranks {
    double u;    /* U statistic: number of pairs with b > a, where ties count as 1/2 */
    double ties; /* tie term: sum of t^3 - t over groups of t equal samples */
};

/* Counts samples that equal `value`, beginning at index `first`. The samples are sorted. */
static uint32_t count_equal(const double *samples, uint32_t first, uint32_t count, double value)
{
    uint32_t end = first;
    while (end < count && samples[end] <= value)
        end++;
    return end - first;
}

static struct ranks rank(const struct profile_pair *pair)
{
    struct ranks ranks = { 0 };
    uint32_t i = 0, j = 0;
    while (i < pair->a_count || j < pair->b_count) {
        const double a = i < pair->a_count ? pair->a[i] : HUGE_VAL;
        const double b = j < pair->b_count ? pair->b[j] : HUGE_VAL;
        const double value = fmin(a, b);
        const uint32_t of_a = count_equal(pair->a, i, pair->a_count, value);
        const uint32_t of_b = count_equal(pair->b, j, pair->b_count, value);
        const double t = (double)of_a + of_b;
        ranks.u += of_b * (i + of_a / 2.0);
        ranks.ties += t * t * t - t;
        i += of_a;
        j += of_b;
    }
    return ranks;
}

/*
 * Returns the exact two-sided p-value 2 * P(U <= u) for `a` and `b` samples. orders[k] is the
 * number of sample orders with U = k. This number is the coefficient of q^k in the product of
 * (1 - q^(b + i)) / (1 - q^i) over i = 1..a.
 */
static double exact_probability(uint32_t a, uint32_t b, uint32_t u)
{
    double orders[PROFILE_EXACT_COUNT * PROFILE_EXACT_COUNT + 1] = { 1 };
    const uint32_t last = a * b;
    double sum = 0, all = 0;
    for (uint32_t i = 1; i <= a; i++) {
        for (uint32_t k = last; k >= b + i; k--)
            orders[k] -= orders[k - (b + i)];
        for (uint32_t k = i; k <= last; k++)
            orders[k] += orders[k - i];
    }
    for (uint32_t k = 0; k <= last; k++) {
        all += orders[k];
        sum += k <= u ? orders[k] : 0;
    }
    return fmin(1, 2 * sum / all);
}

static double normal_probability(double a, double b, const struct ranks *ranks)
{
    const double n = a + b;
    const double variance = a * b / 12 * (n + 1 - ranks->ties / (n * (n - 1)));
    const double distance = fabs(ranks->u - a * b / 2) - 0.5;
    if (variance <= 0) /* all samples are equal */
        return 1;
    return distance <= 0 ? 1 : erfc(distance / sqrt(2 * variance));
}

static bool is_exact(uint32_t a_count, uint32_t b_count)
{
    return a_count <= PROFILE_EXACT_COUNT && b_count <= PROFILE_EXACT_COUNT;
}

double profile_mann_whitney(const struct profile_pair *pair)
{
    assert(pair->a_count > 0 && pair->b_count > 0);
    const double a = pair->a_count, b = pair->b_count;
    const struct ranks ranks = rank(pair);
    if (is_exact(pair->a_count, pair->b_count) && ranks.ties <= 0)
        return exact_probability(pair->a_count, pair->b_count,
                                 (uint32_t)fmin(ranks.u, a * b - ranks.u));
    return normal_probability(a, b, &ranks);
}

double profile_mann_whitney_min(uint32_t a_count, uint32_t b_count)
{
    assert(a_count > 0 && b_count > 0);
    const struct ranks none = { 0 };
    return is_exact(a_count, b_count) ? exact_probability(a_count, b_count, 0)
                                      : normal_probability(a_count, b_count, &none);
}

void profile_holm(const double *p, double *adjusted, uint32_t count)
{
    double last = -1, greatest = 0;
    uint32_t done = 0;
    while (done < count) {
        double next = HUGE_VAL;
        uint32_t ties = 0;
        for (uint32_t i = 0; i < count; i++)
            if (p[i] > last)
                next = fmin(next, p[i]);
        greatest = fmax(greatest, fmin(1, next * (count - done)));
        for (uint32_t i = 0; i < count; i++) {
            if (p[i] > last && p[i] <= next) {
                adjusted[i] = greatest;
                ties++;
            }
        }
        assert(ties > 0); /* false if a p-value is NaN */
        done += ties;
        last = next;
    }
}

/* Returns how many ratios b / a are at most `value`. */
static uint64_t count_ratios(const void *items, double value)
{
    const struct profile_pair *pair = items;
    uint64_t count = 0;
    uint32_t j = 0;
    for (uint32_t i = 0; i < pair->a_count; i++) {
        while (j < pair->b_count && pair->b[j] / pair->a[i] <= value)
            j++;
        count += j;
    }
    return count;
}

struct profile_ratio profile_ratio(const struct profile_pair *pair)
{
    assert(pair->a_count > 0 && pair->b_count > 0);
    const double z = 2.5758293035489004; /* two-sided 99 % quantile, normal distribution */
    const double a = pair->a_count, b = pair->b_count;
    const uint64_t count = (uint64_t)pair->a_count * pair->b_count;
    if (pair->a[0] <= 0 || pair->b[0] <= 0)
        return (struct profile_ratio){ 0 };

    const double margin = floor(a * b / 2 - z * sqrt(a * b * (a + b + 1) / 12));
    const uint64_t skipped = margin > 1 ? (uint64_t)margin - 1 : 0;
    const double middle = find_nth(count_ratios, pair, (count - 1) / 2);
    return (struct profile_ratio){
        .low = find_nth(count_ratios, pair, skipped),
        .ratio = count % 2 ? middle : (middle + find_nth(count_ratios, pair, count / 2)) / 2,
        .high = find_nth(count_ratios, pair, count - 1 - skipped),
    };
}

struct sums {
    double xx, xy, yy;
};

struct profile_fit profile_fit(const double *x, const double *y, uint32_t count)
{
    struct profile_fit fit = { 0 };
    double x_mean = 0, y_mean = 0;
    struct sums sums = { 0 };
    uint32_t used = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (x[i] <= 0)
            continue;
        if (y[i] <= 0)
            return fit;
        x_mean += log(x[i]);
        y_mean += log(y[i]);
        used++;
    }
    if (used < 2)
        return fit;
    x_mean /= used;
    y_mean /= used;
    for (uint32_t i = 0; i < count; i++) {
        if (x[i] <= 0)
            continue;
        const double dx = log(x[i]) - x_mean, dy = log(y[i]) - y_mean;
        sums.xx += dx * dx;
        sums.xy += dx * dy;
        sums.yy += dy * dy;
    }
    if (sums.xx <= used * DBL_EPSILON) /* all x are equal */
        return fit;
    fit.exponent = sums.xy / sums.xx;
    fit.factor = exp(y_mean - fit.exponent * x_mean);
    fit.r2 = sums.yy > 0 ? sums.xy * sums.xy / (sums.xx * sums.yy) : 1;
    fit.point_count = used;
    return fit;
}
