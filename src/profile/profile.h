/*
 * profile.h: struct profile: the time of a frame, by pass, in each of several runs.
 *
 * A run renders the frame twice: once without measurement (`plain`), once with measurement of each
 * pass. The rows of a run add up to its `frame`: GPU passes; `record` and `submit` on the CPU; and
 * `unattributed`, the remainder. That is slightly negative if the GPU starts before the submit call
 * returns on the CPU.
 *
 * Units:     milliseconds, bytes, texels.
 * Ownership: a profile owns all that it points to; profile_finish() frees it and accepts {0}.
 * Errors:    logged; STATUS_TRY_AGAIN when out of memory.
 */
#ifndef FIRN_PROFILE_PROFILE_H
#define FIRN_PROFILE_PROFILE_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"

enum {
    PROFILE_NAME_SIZE = 128
};

enum profile_kind {
    PROFILE_RASTER, /* kinds of GPU passes */
    PROFILE_COMPUTE,
    PROFILE_TRANSFER,
    PROFILE_HOST, /* record, submit */
    PROFILE_REST, /* the row `unattributed` */
    PROFILE_KIND_COUNT,
};

/* A pass, in execution order, or one of the rows after the passes. */
struct profile_row {
    char name[PROFILE_NAME_SIZE];      /* "env_cube.objects", "record", ... */
    char technique[PROFILE_NAME_SIZE]; /* "env_cube"; "" if the row is no pass */
    enum profile_kind kind;
    /* index and number of repetitions of a pass that runs per cube face or object; else 0 of 1 */
    uint32_t repetition, repetition_count;
    uint32_t width, height; /* size of its render targets; 0 if it has none */
    uint64_t target_bytes;  /* total size of its render targets */
    /* Pipeline statistics of one frame, from a separate run; 0 unless has_statistics: */
    uint64_t vertices, triangles, fragments, invocations; /* rg_time.h */
    uint64_t covered;  /* samples that passed the depth test, including those overdrawn later */
    double *ms;        /* duration in each run */
    double *begin_ms;  /* start in each run, relative to the first pass; 0 if the row is no pass */
    double *record_ms; /* CPU time of recording the pass, part of `record`; else 0 */
};

/* Lifetime and memory of a transient image or buffer, for the plot of memory aliasing. */
struct profile_resource {
    char name[PROFILE_NAME_SIZE];
    uint32_t first_pass, last_pass; /* indices of rows */
    uint32_t block;                 /* index of the memory block */
    uint64_t offset, size;          /* in the block */
};

/* Name and value of a setting, as passed to --set. */
struct profile_setting {
    char name[PROFILE_NAME_SIZE], value[PROFILE_NAME_SIZE];
};

struct profile {
    char *command; /* the whole command line */
    char *scene;   /* scene name as on the command line */
    char refraction[PROFILE_NAME_SIZE], material[PROFILE_NAME_SIZE];
    uint32_t width, height; /* of the image */
    struct profile_setting *settings;
    uint32_t setting_count;
    char device[256], driver[256]; /* GPU name; GPU kind, versions of Vulkan and driver */
    char host[256];                /* CPU name and number of threads */
    char clock[32];                /* "timestamps" or "submits" */
    char clock_reason[256];        /* why the timestamp test chose this clock */
    double submit_cost;       /* time of an empty submit, included in passes timed by submits */
    bool has_statistics;      /* the device has pipeline statistics */
    bool fragments_are_exact; /* false if the driver counts whole blocks of them */
    uint32_t warmup;          /* runs before the first measured run */
    uint32_t run_count;
    double time, time_step;  /* scene time of the first run and step per run, seconds */
    uint32_t tree_triangles; /* triangles in the ray tracing BVH; 0 if there is none */
    uint64_t tree_size;      /* size of that BVH, bytes */
    double tree;             /* build time of that BVH, milliseconds */
    uint64_t rays_size;      /* size of the acceleration structures, bytes; 0 if there are none */
    double rays;             /* build time of the acceleration structures, milliseconds */
    /* One-time costs, ms: scene, graph, pipelines, first frame with shader compilation. */
    double upload, compile, realise, first_frame;
    uint64_t memory_used, memory_without_aliasing, memory_bound, memory_persistent;
    struct profile_resource *residents;
    uint32_t resident_count;
    struct profile_row *rows; /* passes, then CPU rows, then the remainder */
    uint32_t row_count, pass_count;
    double *frame; /* time of each measured frame from start to end, by the CPU's clock */
    double *plain; /* time of each frame without measurement, by the CPU's clock */
    double *wait;  /* time that the CPU waited for the GPU in each run, part of `frame` */
};

/* Allocates rows and samples, all 0, for pass_count passes and run_count runs, and adds the rows
 * record, submit and unattributed. The caller sets the names of the passes. */
MUST_USE enum status profile_make_rows(struct profile *profile);

void profile_finish(struct profile *profile);

#endif
