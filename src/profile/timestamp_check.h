/*
 * timestamp_check.h: verifies a device's timestamps by a test, and chooses the clock for passes.
 *
 * A driver may finish a pass long after its timestamp, or attribute its time to the next pass,
 * without any error. Therefore passes of several kinds (heavy and light, fragments and compute,
 * into the same target and another one, a copy) are drawn in one frame with timestamps, and each of
 * them alone, timed by the host's clock. If both agree, timestamps are used; otherwise each pass is
 * submitted alone and timed by the host.
 */
#ifndef FIRN_PROFILE_TIMESTAMP_CHECK_H
#define FIRN_PROFILE_TIMESTAMP_CHECK_H

#include "graph/rg_time.h"
#include "src/gpu/gpu.h"

struct profile_clock {
    enum rg_clock clock;      /* RG_CLOCK_EXACT or RG_CLOCK_SUBMITS */
    char reason[256];         /* why this clock was chosen */
    double submit_cost;       /* milliseconds of an empty submit and the wait for it */
    bool fragments_are_exact; /* the device counts exactly the covered fragments */
};

enum {
    TIMESTAMP_CHECK_PASS_COUNT = 7
};

/* Times of the test's passes, milliseconds; the last pass is empty. */
struct timestamp_check_times {
    double stamped[TIMESTAMP_CHECK_PASS_COUNT]; /* by timestamps, in one frame */
    double alone[TIMESTAMP_CHECK_PASS_COUNT];   /* submitted alone */
};

/* Returns the largest difference of both times over all passes but the last one, relative to the
 * time alone without the submit, but to at least a tenth of all passes' time. */
double timestamp_check_error(const struct timestamp_check_times *times);

/* Greatest error of timestamps that are used. */
#define TIMESTAMP_CHECK_TOLERANCE 0.1

/* Runs the test, which takes a fifth of a second on two idle cores and a few seconds on a busy
 * machine, and fills *clock. `chosen` is the clock that will be used (RG_CLOCK_NONE: *clock's):
 * for submits, which are right on every device, the test is not repeated. A device without
 * timestamps is no failure. */
MUST_USE enum status timestamp_check_run(struct gpu *gpu, enum rg_clock chosen,
                                         struct profile_clock *clock);

#endif
