/*
 * comparison.h: two pictures, layer by layer.
 *
 * A layer is all planes of the same name before its last dot; R, G and B are "beauty". Only planes
 * that both pictures have are measured.
 */
#ifndef FIRN_METRIC_COMPARISON_H
#define FIRN_METRIC_COMPARISON_H

#include "src/image/image.h"
#include "src/metric/angle.h"
#include "src/metric/difference.h"
#include "src/metric/flip.h"

struct comparison_params {
    const struct image *reference, *test; /* of one size */
    const bool *counted;                  /* pixels that count; may be NULL: all */
    bool display;          /* both are made for a display: LDR-FLIP; else HDR-FLIP, but */
    bool has_exposure;     /* LDR-FLIP all the same, with */
    double exposure;       /* stops */
    enum flip_curve curve; /* of HDR-FLIP */
    double ppd;            /* pixels per degree, 1 to FLIP_PPD_MAX */
};

struct comparison_layer {
    char name[IMAGE_NAME_SIZE];
    struct difference difference;
};

/* What is known of both in one number, and may have a limit. */
enum comparison_metric {
    COMPARISON_FLIP,   /* mean, of beauty */
    COMPARISON_RMSE,   /* of beauty, as is */
    COMPARISON_RELMSE, /* this */
    COMPARISON_MAE,    /* and this, clipped to 0 and 1 */
    COMPARISON_ANGLE,  /* mean of exit, degrees */
    COMPARISON_METRIC_COUNT,
};

extern const char *const comparison_metric_names[COMPARISON_METRIC_COUNT];

struct comparison {
    size_t counted; /* pixels */
    bool has_beauty;
    double flip;                     /* mean */
    bool is_hdr;                     /* that FLIP is */
    struct flip_exposures exposures; /* of HDR-FLIP */
    float *errors;                   /* FLIP of each pixel, 0 where it does not count; or NULL */
    bool has_exit;                   /* X, Y and Z */
    struct angle angle;              /* of exit */
    float *degrees;                  /* angle_measure()'s; or NULL */
    bool has_tir;                    /* a class of total internal reflection */
    uint64_t tir_differs, tir_count; /* pixels; of those that leave the object in either */
    struct comparison_layer *layers; /* beauty first, then as in the reference */
    uint32_t layer_count;
    const char **only_reference, **only_test; /* names of planes, borrowed from the images */
    uint32_t only_reference_count, only_test_count;
};

/* False: memory is short, and *comparison is {0}. */
bool comparison_init(struct comparison *comparison, const struct comparison_params *params);

void comparison_finish(struct comparison *comparison);

/* NULL if there is none of that name. */
const struct comparison_layer *comparison_find(const struct comparison *comparison,
                                               const char *name);

/*
 * The layer that a metric is of, NULL if both pictures do not have it; *value is NaN where nothing
 * of it counts.
 */
const struct comparison_layer *comparison_metric(const struct comparison *comparison,
                                                 enum comparison_metric metric, double *value);

#endif
