/*
 * profile_data.h: struct profile: the time of a frame, by pass, in each of several runs.
 *
 * A run renders the frame twice: once without measurement (`plain`), once with measurement of each
 * pass. A run's rows add up to its `frame`: GPU passes; `record` and `submit` on the CPU; and the
 * remainder `unattributed`, slightly negative if the GPU starts before the submit call returns.
 *
 * Units: milliseconds, bytes, texels. Ownership: a profile owns all that it points to;
 * profile_finish() frees it and accepts {0}. Errors: logged; STATUS_TRY_AGAIN when out of memory.
 */
#ifndef FIRN_LAB_PROFILE_PROFILE_DATA_H
#define FIRN_LAB_PROFILE_PROFILE_DATA_H

#include <stdbool.h>
#include <stdint.h>
#include "src/base/status.h"

enum {
    PROFILE_NAME_SIZE = 128
};

enum profile_kind {
    PROFILE_RASTER, /* first kind of GPU pass */
    PROFILE_COMPUTE,
    PROFILE_TRANSFER,
    PROFILE_HOST,         /* record, submit */
    PROFILE_UNATTRIBUTED, /* the row `unattributed` */
    PROFILE_KIND_COUNT,
};

/* Row of a profile: a GPU pass or, after all passes, `record`, `submit` or `unattributed`. */
struct profile_row {
    char name[PROFILE_NAME_SIZE];      /* "env_cube.objects", "record", ... */
    char technique[PROFILE_NAME_SIZE]; /* "env_cube"; "" for other rows */
    enum profile_kind kind;
    /* Index of this repetition and number of repetitions, if a pass is drawn per cube face or
     * object. Otherwise, 0 and 1. */
    uint32_t repetition, repetition_count;
    uint32_t width, height; /* of the render targets; else 0 */
    uint64_t target_bytes;  /* total size of the render targets */
    /* Pipeline statistics, counted in a separate frame. They are 0 unless has_statistics is true.
     */
    uint64_t vertices, triangles, fragments, invocations; /* rg_profile.h */
    uint64_t covered;  /* samples passing depth tests, with overdraw */
    double *ms;        /* per run */
    double *begin_ms;  /* per run, after the first pass */
    double *record_ms; /* CPU recording time per run */
};

/* Lifetime and memory block of a transient image or buffer, for the memory aliasing plot. */
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
    char *scene;   /* as on the command line */
    char refraction[PROFILE_NAME_SIZE], material[PROFILE_NAME_SIZE];
    uint32_t width, height; /* of the image */
    struct profile_setting *settings;
    uint32_t setting_count;
    char device[256], driver[256]; /* GPU name; kind, Vulkan, driver version */
    char host[256];                /* CPU name and thread count */
    char clock[32];                /* "timestamps" or "submits" */
    bool has_statistics;           /* the device has pipeline statistics */
    uint32_t warmup;               /* warm-up runs */
    uint32_t run_count;
    double time, time_step; /* seconds: first run's scene time, step */
    uint32_t bvh_triangles; /* BVH triangles; 0 without a BVH */
    uint64_t bvh_size;      /* BVH size, bytes */
    double bvh_ms;          /* BVH build, milliseconds */
    uint64_t rays_size;     /* acceleration structures, bytes; 0 without */
    double rays;            /* acceleration structure build, milliseconds */
    /* One-time costs in ms: scene upload, graph compilation, resource creation, first frame. */
    double upload, compile, realise, first_frame;
    uint64_t memory_used, memory_without_aliasing, memory_bound, memory_persistent;
    struct profile_resource *residents;
    uint32_t resident_count;
    struct profile_row *rows; /* passes, CPU rows, remainder */
    uint32_t row_count, pass_count;
    double *frame; /* measured frame per run, CPU clock */
    double *plain; /* unmeasured frame per run, CPU clock */
    double *wait;  /* CPU wait for GPU, per run */
};

/* Allocates zeroed rows and samples for pass_count passes and run_count runs. Adds the rows
 * `record`, `submit` and `unattributed`. The caller names the passes' rows. */
MUST_USE enum status profile_make_rows(struct profile *profile);

void profile_finish(struct profile *profile);

#endif
