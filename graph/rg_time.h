/*
 * rg_time.h: what each pass of a frame costs: time, and work that the device counts.
 *
 *     rg_exec_create({ .measured = true, ... })
 *     rg_exec_measure(exec, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
 *     ... rg_exec_begin(), rg_exec_submit(), rg_exec_wait() ...
 *     struct rg_times times = rg_exec_times(exec);
 *
 * All times are nanoseconds. Nothing here allocates: what is needed is made with the executor.
 *
 * Which clock can be trusted depends on the device: measure passes of known cost by two clocks, and
 * compare. RG_CLOCK_SUBMITS needs nothing of the driver but fences that work.
 *
 * The device times of passes, `begin`, `record` and `submit` do not overlap where a frame is waited
 * for before the next one begins; what they leave of `whole` belongs to none of them.
 */
#ifndef RG_TIME_H
#define RG_TIME_H

#include "graph/rg_exec.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How the passes of a frame are told apart. */
enum rg_clock {
    RG_CLOCK_NONE,    /* they are not */
    RG_CLOCK_STREAM,  /* a timestamp after each pass: nearly free, but where passes overlap, work of
                        one may count for its neighbour */
    RG_CLOCK_EXACT,   /* a timestamp, then a full barrier, after each pass: they run one by one */
    RG_CLOCK_SUBMITS, /* each pass is submitted alone and waited for, by the host's clock; its
                         submit and its wait count as its device time, not as the frame's */
    RG_CLOCK_COUNT,
};

/* What is measured. {0}: nothing. */
struct rg_measure {
    enum rg_clock clock;
    bool statistics; /* work is counted too, which takes time of its own */
};

/* What one pass costs. Without a clock its times are 0, without statistics its counts. By
 * timestamps, one that does not run (rg_pass.when) ends where it begins. */
struct rg_pass_time {
    uint64_t begin, end;   /* of the device, from the beginning of the frame's first pass */
    uint64_t record_begin; /* of the host, from the frame's start */
    uint64_t record;       /* of the host: writing the commands of the pass */
    uint64_t vertices;     /* vertex shader invocations */
    uint64_t triangles;    /* triangles that reached the clipper */
    uint64_t fragments;    /* fragment shader invocations; some drivers count whole blocks */
    uint64_t samples;      /* samples that passed the depth test */
    uint64_t invocations;  /* compute shader invocations */
};

/* What one frame costs. It starts with rg_exec_begin() and ends when it has been waited for. */
struct rg_times {
    struct rg_measure measure;         /* how it was measured */
    const struct rg_pass_time *passes; /* in the plan's order; NULL if nothing was measured */
    uint32_t pass_count;
    uint64_t start;  /* of the host's CLOCK_MONOTONIC */
    uint64_t begin;  /* in rg_exec_begin(), waiting for the earlier frame of the slot */
    uint64_t record; /* writing all commands */
    uint64_t submit; /* handing them to the queue */
    uint64_t wait;   /* waiting for the end of the frame */
    uint64_t whole;  /* from start to end */
};

/* Returns whether a clock can be used; only an executor made with `measured` has any, and some
 * queues have no timestamps. */
RG_API bool rg_exec_has_clock(const struct rg_exec *exec, enum rg_clock clock);

/* Sets what frames measure, from the next rg_exec_begin() on. A clock that cannot be used counts as
 * RG_CLOCK_NONE; an executor made without `measured` ignores the call. */
RG_API void rg_exec_measure(struct rg_exec *exec, const struct rg_measure *measure);

/* Returns the times of the frame that was finished last, as seen by rg_exec_wait(), or by the
 * rg_exec_begin() that used its slot again. `passes` belong to the executor and are valid until the
 * next of these calls. */
RG_API struct rg_times rg_exec_times(const struct rg_exec *exec);

#ifdef __cplusplus
}
#endif

#endif
