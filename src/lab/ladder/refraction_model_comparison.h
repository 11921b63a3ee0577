/*
 * refraction_model_comparison.h: compares refraction models with the path-traced reference: errors
 * and costs.
 *
 * Models and reference have the same camera rays. The object's pixels are those in which the
 * reference's layer `path` is above 0. Angles are measured only in those whose first inner surface
 * does not reflect totally (`tir` is 0); FLIP is measured in all pixels.
 *
 * Ownership: struct ladder owns its images; ladder_finish() frees them and accepts {0}. Errors:
 * logged once; the statuses are those of renderer.h and reference.h.
 */
#ifndef FIRN_LAB_LADDER_REFRACTION_MODEL_COMPARISON_H
#define FIRN_LAB_LADDER_REFRACTION_MODEL_COMPARISON_H

#include "src/render/renderer.h"

enum {
    LADDER_MODEL_COUNT = 16 /* upper limit */
};

/* Class of a pixel by the number of total internal reflections on the refracted path. The number
 * comes from the reference's layer `bounces`. */
enum ladder_path_class {
    LADDER_REFRACTED, /* none */
    LADDER_REFLECTED, /* one */
    LADDER_TRAPPED,   /* two or more */
    LADDER_PATH_CLASS_COUNT,
};

extern const char *const ladder_path_class_names[LADDER_PATH_CLASS_COUNT]; /* "refracted", ... */

/* Classes of an object's pixels by inclusions on the refracted path. Classes may overlap. */
enum ladder_inclusion {
    LADDER_CLEAR,
    LADDER_BUBBLES,
    LADDER_CRACKS,
    LADDER_AIR,
    LADDER_INCLUSION_COUNT,
};

extern const char *const ladder_inclusion_names[LADDER_INCLUSION_COUNT]; /* "clear", ... */

/* Errors of a model's image. An error is NaN if its metric covers no pixels. */
struct ladder_error {
    double flip;                                    /* LDR-FLIP at exposure 0, all pixels */
    double mae;                                     /* linear, clamped to 0..1 */
    double mae_unclipped, rmse;                     /* linear */
    double path_class_mae[LADDER_PATH_CLASS_COUNT]; /* MAE per path class */
    double inclusion_mae[LADDER_INCLUSION_COUNT];   /* MAE per inclusion class */
    double angle;                                   /* mean deviation of `exit`, degrees */
    double angle_95;                                /* 95th percentile of `angle` */
    double tir_differs;                             /* fraction of pixels that differ */
    double truth;                                   /* MAE against ladder_params.truth */
    uint64_t not_finite;                            /* values that are NaN or infinite */
};

struct ladder_model {
    const struct technique *refraction;
    struct render_result result; /* beauty, exit, path, bounces, tir; rgba */
    float *flip;                 /* FLIP error of each pixel */
    struct ladder_error error;
    double cost; /* median ms per frame; else 0 */
};

struct ladder {
    uint32_t width, height;
    uint64_t object_count, angle_count;                  /* pixels of mae, rmse; of `angle` */
    uint64_t path_class_counts[LADDER_PATH_CLASS_COUNT]; /* object pixels per path class */
    uint64_t inclusion_counts[LADDER_INCLUSION_COUNT];
    bool is_whole;                       /* copy of ladder_params.is_whole */
    struct render_result reference;      /* models' layers and `remaining` */
    struct ladder_error reference_error; /* all 0 except `truth` */
    double reference_cost;               /* milliseconds to render the reference once */
    char tracer[64];                     /* ray tracing library, from reference_device() */
    struct ladder_model refraction_models[LADDER_MODEL_COUNT];
    uint32_t refraction_model_count;
};

struct ladder_params {
    struct gpu *gpu; /* borrowed until ladder_run() returns */
    const struct scene *scene;
    const struct settings *settings;
    struct renderer_shot shot;
    uint32_t width, height, samples;
    enum pixel_filter filter;
    uint32_t refraction_models; /* bit i: techniques_refraction(i); 0: all */
    const struct image *truth;  /* another renderer's R, G, B */
    const bool *truth_counted;  /* NULL for all object pixels */
    bool is_whole;              /* lists errors by inclusion, too */
    uint32_t run_count;         /* timed frames per model, or 0 */
};

/* Callback that reports `done` of `all` steps of a stage. `stage` is 0 to ladder_stages() - 1. If
 * the callback returns false, ladder_run() returns STATUS_FAILED and logs nothing. */
typedef bool ladder_progress_fn(void *user, uint32_t stage, uint32_t done, uint32_t all);

/* Returns the number of stages: one for the reference, one per model, one for costs if timed. */
uint32_t ladder_stages(const struct ladder_params *params);

/* Renders and measures everything. `progress` may be NULL. On failure *ladder is zeroed. */
MUST_USE enum status ladder_run(struct ladder *ladder, const struct ladder_params *params,
                                ladder_progress_fn *progress, void *user);

void ladder_finish(struct ladder *ladder);

/* Returns the model to which costs are relative: `paper` if it is compared, else the first. */
const struct ladder_model *ladder_base(const struct ladder *ladder);

/* Returns a model's cost divided by that of ladder_base(), or NaN if costs were not measured. */
double ladder_cost_ratio(const struct ladder *ladder, const struct ladder_model *model);

#endif
