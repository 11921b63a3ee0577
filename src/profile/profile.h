/*
 * profile.h: a profile: the costs of a frame in each of several runs.
 *
 * A run draws the frame twice: once without measuring (`plain`), once measured pass by pass. The
 * rows of a run add up to its `frame`: passes on the device; `record` and `submit` on the host;
 * `unattributed`, the rest, which may be a little below 0 if the device begins before the host's
 * call of submit returns.
 *
 * Units:     milliseconds, bytes, texels.
 * Ownership: a profile owns all that it points to; profile_finish() frees it. {0} and half-built
 *            ones are fine.
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
    PROFILE_RASTER, /* passes, on the device */
    PROFILE_COMPUTE,
    PROFILE_TRANSFER,
    PROFILE_HOST, /* record, submit */
    PROFILE_REST, /* the row `unattributed` */
    PROFILE_KIND_COUNT,
};

/* A pass, in the plan's order, or one of the rows after them. */
struct profile_row {
    char name[PROFILE_NAME_SIZE];      /* "env_cube.objects", "record", ... */
    char technique[PROFILE_NAME_SIZE]; /* "env_cube"; "" for rows that are no passes */
    enum profile_kind kind;
    uint32_t repetition, repetition_count; /* of a pass that is repeated, for each face of a cube
                                              or each object; else 0 of 1 */
    uint32_t width, height;                /* of its targets; 0: it has none */
    uint64_t target_bytes;                 /* size of all its targets */
    /* Counted in a separate run of the first run's frame; 0 unless has_statistics: */
    uint64_t vertices, triangles, fragments, invocations; /* rg_time.h */
    uint64_t covered;  /* samples that passed the depth test, including those drawn over later */
    double *ms;        /* duration in each run */
    double *begin_ms;  /* passes: start in each run, from the start of the frame's passes; else 0 */
    double *record_ms; /* passes: the host's time in each run to record it, part of `record` */
};

/* The lifetime and memory of a transient image or buffer, for the diagram of aliasing. */
struct profile_resident {
    char name[PROFILE_NAME_SIZE];
    uint32_t first_pass, last_pass; /* indices of rows */
    uint32_t block;                 /* index of the memory block */
    uint64_t offset, size;          /* in the block */
};

/* The name and value of a setting, as --set takes them. */
struct profile_setting {
    char name[PROFILE_NAME_SIZE], value[PROFILE_NAME_SIZE];
};

struct profile {
    char *command; /* the whole command line */
    char *scene;   /* its name on the command line */
    char rung[PROFILE_NAME_SIZE], material[PROFILE_NAME_SIZE];
    uint32_t width, height; /* of the picture */
    struct profile_setting *settings;
    uint32_t setting_count;
    char device[256], driver[256]; /* name; kind, versions of Vulkan and driver */
    char host[256];                /* name of the processor and number of its threads */
    char clock[32];                /* "timestamps", "submits" */
    char clock_reason[256];        /* the self-test's reason for this clock */
    double submit_cost;            /* of an empty submit: part of every pass timed by submits */
    bool has_statistics;           /* the device has pipeline statistics */
    bool fragments_are_exact;      /* they count each fragment: some drivers count blocks */
    uint32_t warmup;               /* runs before the first measured one */
    uint32_t run_count;
    double time, time_step;  /* the scene's time in seconds: of the first run; from run to run */
    uint32_t tree_triangles; /* of the tree that rays meet; 0: the rung has none */
    uint64_t tree_size;      /* bytes */
    double tree;             /* milliseconds of its build */
    uint64_t rays_size;      /* bytes of acceleration structures; 0: there are none */
    double rays;             /* milliseconds of their build */
    double upload, compile, realise,
        first_frame; /* setup, once: scene, plan, objects and pipelines,
                                                     first frame (the driver compiles shaders) */
    uint64_t memory_used, memory_without_aliasing, memory_bound, memory_persistent;
    struct profile_resident *residents;
    uint32_t resident_count;
    struct profile_row *rows; /* passes, then host, then rest */
    uint32_t row_count, pass_count;
    double *frame; /* of each run: the measured frame, from begin to end, by the host's clock */
    double *plain; /* of each run: the frame without measuring, by the host's clock */
    double *wait;  /* of each run: the host's wait, part of `frame` */
};

/* Allocates the rows and samples, all 0, for pass_count passes and run_count runs, and adds the
 * rows record, submit and unattributed. The caller fills in the passes' names. */
MUST_USE enum status profile_make_rows(struct profile *profile);

void profile_finish(struct profile *profile);

#endif
