/* clock.c: reads the monotonic clock. */
#include "src/base/clock.h"
#include <time.h>

double clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

double clock_ms(void)
{
    return clock_seconds() * 1e3;
}
