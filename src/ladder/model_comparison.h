/*
 * model_comparison.h: compares all refraction models with the path-traced reference: images,
 * errors, costs.
 *
 * Both images of an error have the same camera rays. The object's pixels are those in which the
 * reference's layer `path` is above 0. Angles are measured in those of them without total internal
 * reflection at the first inner surface (`tir` is 0). FLIP is measured in all pixels.
 *
 * Ownership: struct ladder owns its images; ladder_finish() frees them and accepts {0}. Errors:
 * logged once; the statuses are those of renderer.h and reference.h.
 */
#ifndef FIRN_LADDER_MODEL_COMPARISON_H
#define FIRN_LADDER_MODEL_COMPARISON_H

#include "src/render/renderer.h"

enum {
    LADDER_MODEL_COUNT = 16 /* upper limit */
};

/* Classes of an object's pixels by the number of total internal reflections of the path that
 * refracts wherever possible (the reference's layer `bounces`). */
enum ladder_path_class {
    LADDER_REFRACTED, /* none */
    LADDER_REFLECTED, /* one */
    LADDER_TRAPPED,   /* two or more */
    LADDER_PATH_CLASS_COUNT,
};

extern const char *const ladder_path_class_names[LADDER_PATH_CLASS_COUNT]; /* "refracted", ... */

/* Overlapping classes of an object's pixels by the inclusions that the refracted path hits. */
enum ladder_inclusion {
    LADDER_CLEAR,
    LADDER_BUBBLES,
    LADDER_CRACKS,
    LADDER_AIR,
    LADDER_INCLUSION_COUNT,
};

extern const char *const ladder_inclusion_names[LADDER_INCLUSION_COUNT]; /* "clear", ... */

/* Errors of an image; NaN where no pixel is measured. */
struct ladder_error {
    double flip;      /* mean LDR-FLIP of all pixels at exposure 0 (src/metric/flip.h) */
    double mae, rmse; /* of linear colours over the object's pixels; MAE clamps them to 0..1 */
    double path_class_mae[LADDER_PATH_CLASS_COUNT]; /* MAE over pixels of each path class */
    double inclusion_mae[LADDER_INCLUSION_COUNT];   /* MAE over the pixels with each inclusion */
    double angle;        /* mean angle between the directions in `exit`, degrees */
    double angle_95;     /* 95th percentile of that angle, degrees */
    double tir_differs;  /* fraction of the object's pixels in which `tir` differs */
    double truth;        /* MAE against ladder_params.truth */
    uint64_t not_finite; /* NaN or infinite values, which the errors ignore */
};

struct ladder_model {
    const struct technique *refraction;
    struct render_result result; /* layers beauty, exit, path, bounces, tir; rgba */
    float *flip;                 /* FLIP error of each pixel */
    struct ladder_error error;
    double cost; /* median milliseconds per frame; 0 if not measured */
};

struct ladder {
    uint32_t width, height;
    uint64_t object_count, straight_count; /* pixels measured for MAE and RMSE; for angles */
    uint64_t path_class_counts[LADDER_PATH_CLASS_COUNT]; /* pixels of the object in each class */
    uint64_t inclusion_counts[LADDER_INCLUSION_COUNT];
    bool is_whole;                       /* copy of ladder_params.is_whole */
    struct render_result reference;      /* same layers as the models, and `remaining` */
    struct ladder_error reference_error; /* all 0 except `truth` */
    double reference_cost;               /* milliseconds to render the reference once */
    char tracer[64]; /* name of the ray tracing library, from reference_device() */
    struct ladder_model refraction_models[LADDER_MODEL_COUNT];
    uint32_t refraction_model_count;
};

struct ladder_params {
    struct gpu *gpu; /* gpu, scene and settings are borrowed until ladder_run() returns */
    const struct scene *scene;
    const struct settings *settings;
    struct renderer_shot shot;
    uint32_t width, height, samples;
    enum pixel_filter filter;
    uint32_t refraction_models; /* bit i selects techniques_refraction(i); 0 for all */
    const struct image *truth;  /* R, G, B of another renderer's image; may be NULL */
    const bool *truth_counted;  /* mask for `truth`; NULL for the object's pixels */
    bool is_whole;              /* the object has inclusions: errors are also listed by inclusion */
    uint32_t run_count;         /* timed frames of each model; 0 to skip the cost measurement */
    enum rg_sharing sharing;
};

/* Called with the current stage, below ladder_stages(), and its progress. If it returns false,
 * ladder_run() stops with STATUS_FAILED and logs nothing. */
typedef bool ladder_progress_fn(void *user, uint32_t stage, uint32_t done, uint32_t all);

/* Returns the number of progress stages: the reference, each refraction model, the costs. */
uint32_t ladder_stages(const struct ladder_params *params);

/* Renders all images, measures errors and costs. `progress` may be NULL. On failure *ladder is {0}.
 */
MUST_USE enum status ladder_run(struct ladder *ladder, const struct ladder_params *params,
                                ladder_progress_fn *progress, void *user);

void ladder_finish(struct ladder *ladder);

/* Returns the refraction model whose cost is defined as 1: `paper`, else the first one. */
const struct ladder_model *ladder_base(const struct ladder *ladder);

/* Returns a model's cost relative to ladder_base(); NaN if costs were not measured. */
double ladder_cost_ratio(const struct ladder *ladder, const struct ladder_model *refraction);

#endif
