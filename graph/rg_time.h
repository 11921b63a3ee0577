/*
 * rg_time.h: what each pass of a frame costs: time, and work counted by the device.
 *
 *     rg_exec_create({ .measured = true, ... })
 *     rg_exec_measure(exec, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
 *     ... rg_exec_begin(), rg_exec_submit(), rg_exec_wait() ...
 *     struct rg_times times = rg_exec_times(exec);
 *
 * Times are nanoseconds. Nothing here allocates: all is made with the executor.
 *
 * Which clock tells the truth depends on the device, so ask it: run passes of known cost by two
 * clocks and compare. RG_CLOCK_SUBMITS needs nothing of the driver but fences that work.
 *
 * The passes' device times, `begin`, `record` and `submit` do not overlap where a frame is waited
 * for before the next one begins: what they leave of `whole` is nobody's.
 */
#ifndef RG_TIME_H
#define RG_TIME_H

#include "graph/rg_exec.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a frame's passes are told apart. */
enum rg_clock {
    RG_CLOCK_NONE,
    /* A timestamp after each pass. Next to free, but passes may overlap: what runs beside another
     * pass is billed to one of the two. */
    RG_CLOCK_STREAM,
    /* A timestamp, then a full barrier after each pass: they run one after another. */
    RG_CLOCK_EXACT,
    /* Each pass is submitted alone and waited for, by the host's clock. Its submit and its wait are
     * then part of its device time, not of the frame's. */
    RG_CLOCK_SUBMITS,
    RG_CLOCK_COUNT,
};

struct rg_measure {
    enum rg_clock clock;
    bool statistics; /* count work, too; costs time of its own */
};

struct rg_pass_time {
    uint64_t begin, end;   /* device, from the frame's first; 0 without a clock */
    uint64_t record_begin; /* host, from the frame's start */
    uint64_t record;       /* host: writing its commands */
    uint64_t vertices;     /* vertex shader invocations; this and all below 0 without statistics */
    uint64_t triangles;    /* that reached the clipper */
    uint64_t fragments;    /* fragment shader invocations; some drivers count whole blocks */
    uint64_t samples;      /* that passed the depth test */
    uint64_t invocations;  /* of compute shaders */
};

/* Of a frame. It starts when rg_exec_begin() is called and ends when it has been waited for. */
struct rg_times {
    struct rg_measure measure;         /* as it was measured */
    const struct rg_pass_time *passes; /* in the plan's order; NULL if nothing was measured */
    uint32_t pass_count;
    uint64_t start;  /* host, CLOCK_MONOTONIC */
    uint64_t begin;  /* host: in rg_exec_begin(), waiting for the slot's earlier frame */
    uint64_t record; /* host: writing all commands */
    uint64_t submit; /* host: handing them to the queue */
    uint64_t wait;   /* host: in the waits for its end */
    uint64_t whole;  /* host: from its start to its end */
};

/* Whether a clock is there (timestamps may not be), for an executor made to measure. */
RG_API bool rg_exec_has_clock(const struct rg_exec *exec, enum rg_clock clock);

/*
 * What frames measure from the next rg_exec_begin() on; nothing unless the executor was made to
 * measure. A clock that is not there is taken as RG_CLOCK_NONE.
 */
RG_API void rg_exec_measure(struct rg_exec *exec, const struct rg_measure *measure);

/*
 * Of the frame that was seen finished last, by rg_exec_wait() or by the rg_exec_begin() that took
 * its slot again. `passes` are valid until the next of these calls.
 */
RG_API struct rg_times rg_exec_times(const struct rg_exec *exec);

#ifdef __cplusplus
}
#endif

#endif
