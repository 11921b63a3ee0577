/*
 * ladder.h: compares every rung of refraction with the reference: pictures, errors, costs.
 *
 * Both pictures of an error have equal rays. Pixels of the object are those in which the
 * reference's layer `path` is above 0; angles are measured in those of them in which light is not
 * totally reflected at the first inner surface (`tir` is 0); FLIP is measured in all pixels.
 *
 * Ownership: a ladder owns its pictures; ladder_finish() frees them. {0} and half-built ones are
 *            fine.
 * Errors:    logged once; the statuses are those of renderer.h and reference.h.
 */
#ifndef FIRN_LADDER_LADDER_H
#define FIRN_LADDER_LADDER_H

#include "src/render/renderer.h"

enum {
    LADDER_RUNG_COUNT = 16 /* at most */
};

/* What becomes of the light that is refracted wherever it can be, in pixels of the object: how
 * often it is totally reflected (the reference's layer `bounces`). */
enum ladder_cause {
    LADDER_REFRACTED, /* never */
    LADDER_REFLECTED, /* once */
    LADDER_TRAPPED,   /* more often */
    LADDER_CAUSE_COUNT,
};

extern const char *const ladder_cause_names[LADDER_CAUSE_COUNT]; /* "refracted", ... */

/* What that light meets: inclusions, or none. A pixel may have several. */
enum ladder_inclusion {
    LADDER_CLEAR,
    LADDER_BUBBLES,
    LADDER_CRACKS,
    LADDER_AIR,
    LADDER_INCLUSION_COUNT,
};

extern const char *const ladder_inclusion_names[LADDER_INCLUSION_COUNT]; /* "clear", ... */

/* Errors of a picture; they are NaN if no pixel is measured. */
struct ladder_error {
    double flip;      /* LDR-FLIP (src/metric/flip.h), exposure 0, mean of all pixels */
    double mae, rmse; /* of the object's pixels, linear; mae clipped to 0 and 1 */
    double cause_mae[LADDER_CAUSE_COUNT];         /* mae of the pixels of each cause */
    double inclusion_mae[LADDER_INCLUSION_COUNT]; /* mae of the pixels that have each */
    double angle;        /* mean angle between the directions of `exit`, degrees */
    double angle_95;     /* 95th percentile of that angle, degrees */
    double tir_differs;  /* share of the object's pixels in which `tir` differs */
    double truth;        /* mae against ladder_params.truth */
    uint64_t not_finite; /* values of the object that are NaN or infinite; the errors ignore them */
};

struct ladder_rung {
    const struct technique *rung;
    struct render_result result; /* beauty, exit, path, bounces, tir; rgba */
    float *flip;                 /* of each pixel */
    struct ladder_error error;
    double cost; /* median milliseconds per frame; 0: not measured */
};

struct ladder {
    uint32_t width, height;
    uint64_t object_count, straight_count;     /* pixels measured for mae and rmse; for angles */
    uint64_t cause_counts[LADDER_CAUSE_COUNT]; /* pixels of the object */
    uint64_t inclusion_counts[LADDER_INCLUSION_COUNT];
    bool is_whole;                       /* ladder_params.is_whole */
    struct render_result reference;      /* the layers of rungs, and `remaining` */
    struct ladder_error reference_error; /* zeros, except for truth */
    double reference_cost;               /* milliseconds of one picture */
    char tracer[64];                     /* reference_device() */
    struct ladder_rung rungs[LADDER_RUNG_COUNT];
    uint32_t rung_count;
};

struct ladder_params {
    struct gpu *gpu; /* this, scene and settings are borrowed until ladder_run() returns */
    const struct scene *scene;
    const struct settings *settings;
    struct renderer_shot shot;
    uint32_t width, height, samples;
    enum pixel_filter filter;
    uint32_t rungs;            /* bit i: techniques_rung(i); 0: all */
    const struct image *truth; /* R, G, B of this size, by another program; NULL: none */
    const bool *truth_counted; /* pixels of it to measure; NULL: the object's */
    bool is_whole;             /* the object has inclusions: errors are told by these, too */
    uint32_t run_count;        /* timed frames of each rung; 0: costs are not measured */
    enum rg_sharing sharing;
};

/* Called with the stage, from 0 to below ladder_stages(), and the finished part of it. If it
 * returns false, the ladder stops with STATUS_FAILED and logs nothing. */
typedef bool ladder_progress_fn(void *user, uint32_t stage, uint32_t done, uint32_t all);

/* Returns the number of stages: the reference, every rung, the costs. */
uint32_t ladder_stages(const struct ladder_params *params);

/* Draws, traces and measures. `progress` may be NULL. On failure *ladder is {0}. */
MUST_USE enum status ladder_run(struct ladder *ladder, const struct ladder_params *params,
                                ladder_progress_fn *progress, void *user);

void ladder_finish(struct ladder *ladder);

/* Returns the rung whose relative cost is 1: `paper`, else the first one. */
const struct ladder_rung *ladder_base(const struct ladder *ladder);

/* Returns the cost relative to ladder_base(); NaN if costs were not measured. */
double ladder_cost_ratio(const struct ladder *ladder, const struct ladder_rung *rung);

#endif
