/* quantile.c: median and quantiles of float arrays. */
#include "src/lab/metric/quantile.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

void quantile_sort(float *values, size_t count)
{
    qsort(values, count, sizeof(*values), compare);
}

double quantile_median(const float *sorted, size_t count)
{
    assert(count > 0);
    return 0.5 * ((double)sorted[(count - 1) / 2] + (double)sorted[count / 2]);
}

double quantile_at(const float *sorted, size_t count, double fraction)
{
    assert(count > 0);
    const double rank = ceil(fraction * (double)count);
    return (double)sorted[rank < 1.0 ? 0 : (size_t)rank - 1];
}
