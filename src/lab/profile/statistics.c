/* statistics.c: mean, standard deviation, quantiles, and the Mann-Whitney test. */
#include "src/lab/profile/statistics.h"
#include <assert.h>
#include <math.h>
#include <stdbool.h>
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

static bool has_more_than(const double *samples, uint32_t count, double limit, uint32_t index)
{
    uint32_t at_most = 0;
    for (uint32_t i = 0; i < count; i++)
        at_most += samples[i] <= limit;
    return at_most > index;
}

/* Returns sample `index` in ascending order, by bisection over the bits of a double. */
static double find_nth(const double *samples, uint32_t count, uint32_t index)
{
    uint64_t key = 0;
    for (int bit = 63; bit >= 0; bit--) {
        const double value = from_key((key | UINT64_C(1) << bit) - 1);
        /* Keys beyond the infinities encode NaN. */
        const bool is_above =
            isnan(value) ? !signbit(value) : has_more_than(samples, count, value, index);
        if (!is_above)
            key |= UINT64_C(1) << bit;
    }
    return from_key(key) + 0.0; /* turns -0 into 0 */
}

static double quantile(const double *samples, uint32_t count, double portion)
{
    const double place = portion * (count - 1);
    const uint32_t index = (uint32_t)place;
    const double below = find_nth(samples, count, index);
    if (place <= (double)index)
        return below;
    const double above = find_nth(samples, count, index + 1);
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
        .min = quantile(samples, count, 0),
        .median = quantile(samples, count, 0.5),
        .p95 = quantile(samples, count, 0.95),
        .max = quantile(samples, count, 1),
    };
}

static double normal_probability(double a_count, double b_count, double u)
{
    const double pairs = a_count * b_count;
    const double distance = fabs(u - pairs / 2) - 0.5;
    return distance > 0 ? erfc(distance / sqrt(pairs * (a_count + b_count + 1) / 6)) : 1;
}

double profile_mann_whitney(const struct profile_pair *pair)
{
    assert(pair->a_count > 0 && pair->b_count > 0);
    uint32_t below = 0, at_most = 0; /* samples of a relative to a sample of b */
    double u = 0;                    /* number of pairs with a < b, where ties count as 1/2 */
    for (uint32_t i = 0; i < pair->b_count; i++) {
        while (below < pair->a_count && pair->a[below] < pair->b[i])
            below++;
        while (at_most < pair->a_count && pair->a[at_most] <= pair->b[i])
            at_most++;
        u += ((double)below + at_most) / 2;
    }
    return normal_probability(pair->a_count, pair->b_count, u);
}

double profile_mann_whitney_min(uint32_t a_count, uint32_t b_count)
{
    return normal_probability(a_count, b_count, 0);
}
