/* clock.h: monotonic time for measuring durations. Any thread may call these functions. */
#ifndef FIRN_BASE_CLOCK_H
#define FIRN_BASE_CLOCK_H

/* Returns seconds since an unspecified time; the value never decreases. */
double clock_seconds(void);

/* Returns the CPU time of all threads of this process, in seconds. */
double clock_cpu_seconds(void);

/* Returns clock_seconds() in milliseconds. */
static inline double clock_ms(void)
{
    return clock_seconds() * 1e3;
}

#endif
