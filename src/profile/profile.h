/*
 * profile.h: what a frame cost, run by run: measured, written, read again, compared.
 *
 * A run draws the frame twice: once with nothing measured (`plain`), once measured pass by pass.
 * The rows of a run add up to its `frame`: passes on the device; `record` and `submit` on the host;
 * `unattributed`, what is left (it may be a little below 0 where the device begins before the
 * host's call of submit is over).
 *
 * Units:     milliseconds, bytes, texels.
 * Ownership: a profile owns all it points to; profile_finish() frees it. {0} and half-built ones
 *            are fine.
 * Errors:    logged; STATUS_TRY_AGAIN when memory is short.
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
    PROFILE_REST, /* unattributed */
    PROFILE_KIND_COUNT,
};

/* A pass, in the plan's order, or one of the rows after them. */
struct profile_row {
    char name[PROFILE_NAME_SIZE];      /* "env_cube.objects", "record", ... */
    char technique[PROFILE_NAME_SIZE]; /* "env_cube"; "" for rows that are no passes */
    enum profile_kind kind;
    uint32_t repetition, repetition_count; /* of its row of the table: cube faces; 0 of 1 */
    uint32_t width, height;                /* of its targets; 0: it has none */
    uint64_t target_bytes;                 /* of all its targets, as large as they are */
    /* Counted in a run of its own, of the frame of the first run; 0 unless has_statistics: */
    uint64_t vertices, triangles, fragments, invocations; /* rg_time.h */
    uint64_t covered;  /* samples that passed the depth test, drawn over each other counted again */
    double *ms;        /* one a run */
    double *begin_ms;  /* the same, from the start of the frame's passes on the device; else 0 */
    double *record_ms; /* host: what writing its commands took, within the row `record`; else 0 */
};

/* Of an image or buffer in transient memory: for the picture of who lies where, when. */
struct profile_resident {
    char name[PROFILE_NAME_SIZE];
    uint32_t first_pass, last_pass; /* indices of rows */
    uint32_t block;                 /* of memory */
    uint64_t offset, size;          /* in it */
};

/* A name and what it is set to, both as --set takes them. */
struct profile_setting {
    char name[PROFILE_NAME_SIZE], value[PROFILE_NAME_SIZE];
};

struct profile {
    char *command; /* the whole command line */
    char *scene;   /* as the command line names it */
    char rung[PROFILE_NAME_SIZE], material[PROFILE_NAME_SIZE];
    uint32_t width, height; /* of the picture */
    struct profile_setting *settings;
    uint32_t setting_count;
    char device[256], driver[256]; /* its name; kind, Vulkan's and the driver's version */
    char host[256];                /* the processor's name and its number of threads */
    char clock[32];                /* "timestamps", "submits" */
    char clock_reason[256];        /* why this one: what the self-test found */
    double submit_cost;            /* of an empty submit: part of every pass timed by submits */
    bool has_statistics;           /* the device counts */
    bool fragments_are_exact;      /* and does so for fragments: some drivers count blocks */
    uint32_t warmup;               /* runs before the first, not kept */
    uint32_t run_count;
    double time, time_step; /* seconds of the scene: of the first run, and from run to run */
    double upload, compile, realise, first_frame; /* once: scene, plan, objects and pipelines, and
                                                     the first frame (shaders are translated) */
    uint64_t memory_used, memory_without_aliasing, memory_bound, memory_persistent;
    struct profile_resident *residents;
    uint32_t resident_count;
    struct profile_row *rows; /* passes, then host, then rest */
    uint32_t row_count, pass_count;
    double *frame; /* one a run: a measured frame, from its begin to its end, by the host */
    double *plain; /* the same of the frame that was not measured */
    double *wait;  /* the host's wait within `frame` */
};

/* Room for the rows' and the frames' samples, all 0, as pass_count and run_count say: adds the rows
 * record, submit and unattributed. The names of the passes are the caller's to fill. */
MUST_USE enum status profile_make_rows(struct profile *profile);

void profile_finish(struct profile *profile);

#endif
