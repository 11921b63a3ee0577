/*
 * ladder.h: every rung of refraction beside the traced reference: pictures, errors, costs.
 *
 * Errors are those of two pictures from the very same rays. Which pixels count: those where the
 * reference has the object (its layer `path` is above 0); for angles, of these, where light is not
 * totally reflected at the first surface inside (`tir` is 0); for FLIP, all.
 *
 * Ownership: a ladder owns its pictures; ladder_finish() frees them. {0} and half-built ones are
 *            fine.
 * Errors:    logged once where found: those of renderer.h and reference.h.
 */
#ifndef FIRN_LADDER_LADDER_H
#define FIRN_LADDER_LADDER_H

#include "src/render/renderer.h"

enum {
    LADDER_RUNG_COUNT = 16 /* at most */
};

/* Numbers that do not exist, for no pixel counts, are NaN. */
struct ladder_error {
    double flip;         /* LDR-FLIP (src/metric/flip.h), exposure 0, mean of all pixels */
    double mae, rmse;    /* of the object's pixels, linear; mae clipped to 0 and 1 */
    double angle;        /* degrees between the directions of `exit`, mean */
    double angle_95;     /* and what 95 % of the pixels do not exceed */
    double tir_differs;  /* share of the object's pixels of another class of total reflection */
    double truth;        /* mae beside ladder_params.truth */
    uint64_t not_finite; /* values of the object that are NaN or infinite: they are in no error */
};

struct ladder_rung {
    const struct technique *rung;
    struct render_result result; /* beauty, exit, path, bounces, tir; rgba */
    float *flip;                 /* of each pixel */
    struct ladder_error error;
    double cost; /* milliseconds a frame, median; 0: not measured */
};

struct ladder {
    uint32_t width, height;
    uint64_t object_count, straight_count; /* pixels for mae and rmse; for angles */
    struct render_result reference;        /* as of rungs, and remaining */
    struct ladder_error reference_error;   /* zeros, but for truth */
    double reference_cost;                 /* milliseconds, once */
    char tracer[64];                       /* reference_device() */
    struct ladder_rung rungs[LADDER_RUNG_COUNT];
    uint32_t rung_count;
};

struct ladder_params {
    struct gpu *gpu; /* this, scene and settings are borrowed until ladder_run() returns */
    const struct scene *scene;
    const struct settings *settings;
    struct renderer_shot shot;
    uint32_t width, height, samples;
    uint32_t rungs;            /* bit i: techniques_rung(i); 0: all */
    const struct image *truth; /* R, G, B of this size by another program; NULL: none */
    const bool *truth_counted; /* pixels of it that count; NULL: the object's */
    uint32_t run_count; /* frames of each rung whose time counts; 0: costs are not measured */
    enum rg_sharing sharing;
};

/* What is at work: the reference (NULL), a rung, or all of them ("costs"), and how much of it is
 * done. False stops with STATUS_FAILED, nothing logged. */
typedef bool ladder_progress_fn(void *user, uint32_t stage, uint32_t done, uint32_t all);

/* Stages there are: the reference, every rung, costs. */
uint32_t ladder_stages(const struct ladder_params *params);

/* Draws, traces and measures. On failure *ladder is {0}. */
MUST_USE enum status ladder_run(struct ladder *ladder, const struct ladder_params *params,
                                ladder_progress_fn *progress, void *user);

void ladder_finish(struct ladder *ladder);

/* The rung whose cost is 1 in comparisons: `paper`, else the first. */
const struct ladder_rung *ladder_base(const struct ladder *ladder);

/* Cost beside ladder_base()'s; NaN if costs were not measured. */
double ladder_cost_ratio(const struct ladder *ladder, const struct ladder_rung *rung);

#endif
