/* sweep_significance.c: tests the difference in frame rate of two points of a sweep. */
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/lab/profile/sweep_power_law.h"

static double *sorted_copy(const struct profile *p)
{
    double *copy = calloc(p->run_count, sizeof(*copy));
    if (copy) {
        memcpy(copy, p->plain, p->run_count * sizeof(*copy));
        profile_sort(copy, p->run_count);
    }
    return copy;
}

/* Returns the unadjusted p-value of one contrast, or a negative value when out of memory. */
static double test_contrast(const struct profile_sweep *sweep, struct profile_contrast *contrast)
{
    const struct profile *before = &sweep->points[contrast->before];
    const struct profile *after = &sweep->points[contrast->after];
    double *times[2] = { sorted_copy(after), sorted_copy(before) };
    double p = -1;
    if (times[0] && times[1]) {
        const struct profile_pair pair = {
            .a = times[0],
            .b = times[1],
            .a_count = after->run_count,
            .b_count = before->run_count,
        };
        contrast->rate = profile_ratio(&pair); /* inverse of the time ratio */
        p = profile_mann_whitney(&pair);
    }
    free(times[0]);
    free(times[1]);
    return p;
}

enum status profile_contrast_all(struct profile_sweep *sweep)
{
    const uint32_t count = sweep->contrast_count;
    double *p = calloc(2 * (size_t)count + 1, sizeof(*p));
    bool done = p;
    for (uint32_t i = 0; i < count && done; i++) {
        p[i] = test_contrast(sweep, &sweep->contrasts[i]);
        done = p[i] >= 0;
    }
    if (done)
        profile_holm(p, p + count, count);
    for (uint32_t i = 0; i < count && done; i++)
        sweep->contrasts[i].p = p[count + i];
    free(p);
    return done ? STATUS_OK : log_out_of_memory(NULL);
}
