/*
 * rg_profile.h: profiling of passes: GPU and CPU times, and pipeline statistics.
 *
 *     rg_exec_create({ .measured = true, ... })
 *     rg_exec_measure(exec, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
 *     ... rg_exec_begin(), rg_exec_submit(), rg_exec_wait() ...
 *     struct rg_times times = rg_exec_times(exec);
 *
 * All times are nanoseconds. Some devices' timestamps are unreliable; RG_CLOCK_SUBMITS only relies
 * on fences. The GPU times of passes, `begin`, `record` and `submit` do not overlap if frames are
 * waited for before the next one begins; the rest of `whole` is not attributed.
 */
#ifndef RG_RG_PROFILE_H
#define RG_RG_PROFILE_H

#include "graph/rg_exec.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Method by which the times of individual passes are measured. */
enum rg_clock {
    RG_CLOCK_NONE, /* not at all */
    /* a timestamp after each pass; nearly free, but inexact where passes overlap on the GPU */
    RG_CLOCK_STREAM,
    RG_CLOCK_EXACT, /* timestamp and full barrier per pass */
    /* one submission per pass, timed on the CPU from submission until the pass has finished */
    RG_CLOCK_SUBMITS,
    RG_CLOCK_COUNT,
};

/* Measurements to make; a zeroed struct makes none. */
struct rg_measure {
    enum rg_clock clock;
    bool statistics; /* pipeline statistics; costs some time */
};

/* Cost of one pass. Without a clock, times are 0. Without statistics, and for passes with
 * rg_pass.secondary or rg_pass.multiview, counts are 0. If a pass is skipped (rg_pass.when), `end`
 * is equal to `begin`. */
struct rg_pass_time {
    uint64_t begin, end;   /* GPU time from first pass's start */
    uint64_t record_begin; /* CPU time since frame start */
    uint64_t record;       /* CPU time of recording */
    uint64_t vertices;     /* vertex shader invocations */
    uint64_t triangles;    /* triangles that reached the clipper */
    uint64_t fragments;    /* fragment shader invocations, perhaps rounded up */
    uint64_t samples;      /* samples that passed the depth test */
    uint64_t invocations;  /* compute shader invocations */
};

/* Cost of one frame, from rg_exec_begin() until it has been waited for. */
struct rg_times {
    struct rg_measure measure;         /* how it was measured */
    const struct rg_pass_time *passes; /* per plan pass; NULL without measurement */
    uint32_t pass_count;
    uint64_t start;  /* CLOCK_MONOTONIC; on Windows QueryPerformanceCounter() */
    uint64_t begin;  /* waiting for the slot's previous frame */
    uint64_t record; /* recording all commands */
    uint64_t submit; /* submitting them to the queue */
    uint64_t wait;   /* waiting for the frame to finish */
    uint64_t whole;  /* from start to end */
};

/* Returns true if a clock works, which requires `measured`, for timestamps queue support, and a
 * plan that uses only the main queue. */
RG_API bool rg_exec_has_clock(const struct rg_exec *exec, enum rg_clock clock);

/* Sets what is measured in frames from the next rg_exec_begin() on. If a clock cannot be used, it
 * counts as RG_CLOCK_NONE. If the executor was created without `measured`, nothing changes. */
RG_API void rg_exec_measure(struct rg_exec *exec, const struct rg_measure *measure);

/* Returns the times of the frame that finished last. The executor owns `passes`, which is valid
 * until the next rg_exec_wait() or rg_exec_begin(). */
RG_API struct rg_times rg_exec_times(const struct rg_exec *exec);

#ifdef __cplusplus
}
#endif

#endif
