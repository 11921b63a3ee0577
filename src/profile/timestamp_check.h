/*
 * timestamp_check.h: which clock tells the truth about passes on a device, found out by trying.
 *
 * A driver may finish a pass long after its timestamp, or bill it to the next one, and says nothing
 * of it. So passes of several kinds (heavy and light, fragments and compute, into the same target
 * and another one, a copy) are drawn in one frame with timestamps, and each alone between two looks
 * at the host's clock. Where both agree, timestamps are truthful; else passes are submitted alone.
 */
#ifndef FIRN_PROFILE_TIMESTAMP_CHECK_H
#define FIRN_PROFILE_TIMESTAMP_CHECK_H

#include "graph/rg_time.h"
#include "src/gpu/gpu.h"

struct profile_clock {
    enum rg_clock clock;      /* RG_CLOCK_EXACT or RG_CLOCK_SUBMITS */
    char reason[256];         /* in words */
    double submit_cost;       /* milliseconds of a submit that does nothing, waited for */
    bool fragments_are_exact; /* the device counts as many as were covered */
};

enum {
    TIMESTAMP_CHECK_PASS_COUNT = 7
};

/* Of the passes of the test, milliseconds; the last one does nothing. */
struct timestamp_check_times {
    double stamped[TIMESTAMP_CHECK_PASS_COUNT]; /* by timestamps, in one frame */
    double alone[TIMESTAMP_CHECK_PASS_COUNT];   /* submitted alone */
};

/* The largest difference of the two for any pass but the last, relative to the time alone less the
 * submit (but to no less than a tenth of all passes' time). */
double timestamp_check_error(const struct timestamp_check_times *times);

/* Timestamps that err more are not used. */
#define TIMESTAMP_CHECK_TOLERANCE 0.1

/* Takes a fifth of a second on two cores, and a few where other programs run. A device without
 * timestamps is no failure. */
MUST_USE enum status timestamp_check_run(struct gpu *gpu, struct profile_clock *clock);

#endif
