/* clock.h: monotonic time for measuring durations. Any thread may call these functions. */
#ifndef FIRN_BASE_CLOCK_H
#define FIRN_BASE_CLOCK_H

#include <time.h>

/* Returns seconds since an unspecified time; the value never decreases. */
static inline double clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* Returns clock_seconds() in milliseconds. */
static inline double clock_ms(void)
{
    return clock_seconds() * 1e3;
}

#endif
