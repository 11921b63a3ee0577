/*
 * timestamp_check.h: tests whether a device's timestamps are reliable, and chooses a clock for
 * passes.
 *
 * A driver may finish a pass long after its timestamp, or attribute its time to the next pass,
 * without reporting an error. The test renders diverse passes (heavy and light, graphics and
 * compute, same and different render targets, a copy) with timestamps in one frame, and each pass
 * alone, timed by the CPU's clock. Unless both agree, passes are submitted and timed by the CPU one
 * by one.
 */
#ifndef FIRN_LAB_PROFILE_TIMESTAMP_CHECK_H
#define FIRN_LAB_PROFILE_TIMESTAMP_CHECK_H

#include "graph/rg_profile.h"
#include "src/gpu/gpu.h"

struct profile_clock {
    enum rg_clock clock;      /* RG_CLOCK_EXACT or RG_CLOCK_SUBMITS */
    char reason[256];         /* why this clock was chosen */
    double submit_cost;       /* empty submit and wait, milliseconds */
    bool fragments_are_exact; /* the counter excludes uncovered fragments */
};

enum {
    TIMESTAMP_CHECK_PASS_COUNT = 7
};

/* Times of the test's passes, in milliseconds. The last pass is empty. */
struct timestamp_check_times {
    double stamped[TIMESTAMP_CHECK_PASS_COUNT]; /* by timestamps, in one frame */
    double alone[TIMESTAMP_CHECK_PASS_COUNT];   /* submitted alone, by the CPU's clock */
};

/* Returns the maximum relative error of `stamped` against `alone` minus the cost of submitting.
 * Errors of short passes are relative to a tenth of the total time instead of the pass time. */
double timestamp_check_error(const struct timestamp_check_times *times);

/* Maximum relative error at which timestamps are used. */
#define TIMESTAMP_CHECK_TOLERANCE 0.1

/* Tests GPU timestamps and fills *clock. Takes 0.2 s on two idle cores, a few seconds on a busy
 * machine. `chosen` is the user's clock. RG_CLOCK_SUBMITS works on every device, so it is tested
 * only once. Missing timestamps are not an error. */
MUST_USE enum status timestamp_check_run(struct gpu *gpu, enum rg_clock chosen,
                                         struct profile_clock *clock);

#endif
