/* error_sums.c: accumulates the sums of RMSE, MAE and relMSE. */
#include "src/lab/metric/error_sums.h"
#include <math.h>

static double clip(double value)
{
    return fmin(fmax(value, 0.0), 1.0);
}

void difference_add(struct difference *difference, const float *reference, const float *test,
                    const bool *counted, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double r = (double)reference[i], t = (double)test[i];
        if (counted && !counted[i])
            continue;
        if (!isfinite(r) || !isfinite(t)) {
            difference->not_finite++;
            continue;
        }
        const double square = (t - r) * (t - r);
        difference->clipped_absolutes += fabs(clip(t) - clip(r));
        difference->absolutes += fabs(t - r);
        difference->squares += square;
        difference->relative_squares += square / (r * r + 0.01);
        difference->largest = fmax(difference->largest, fabs(t - r));
        difference->count++;
    }
}

double difference_rmse(const struct difference *difference)
{
    return difference->count ? sqrt(difference->squares / (double)difference->count) : (double)NAN;
}

double difference_mae(const struct difference *difference)
{
    return difference->count ? difference->clipped_absolutes / (double)difference->count
                             : (double)NAN;
}

double difference_mae_unclipped(const struct difference *difference)
{
    return difference->count ? difference->absolutes / (double)difference->count : (double)NAN;
}

double difference_relmse(const struct difference *difference)
{
    return difference->count ? difference->relative_squares / (double)difference->count
                             : (double)NAN;
}
