/*
 * comparison.h: compares two images layer by layer.
 *
 * A layer is all planes with the same name before the last dot; R, G and B are "beauty". Only
 * planes that both pictures have are measured.
 */
#ifndef FIRN_METRIC_COMPARISON_H
#define FIRN_METRIC_COMPARISON_H

#include "src/image/image.h"
#include "src/metric/angle.h"
#include "src/metric/difference.h"
#include "src/metric/flip.h"

struct comparison_params {
    const struct image *reference, *test; /* of one size */
    const bool *counted;                  /* pixels to compare; NULL: all */
    bool display;          /* display-referred images: LDR-FLIP; else HDR-FLIP, unless: */
    bool has_exposure;     /* LDR-FLIP with `exposure` */
    double exposure;       /* stops */
    enum flip_curve curve; /* tone curve of HDR-FLIP */
    double ppd;            /* pixels per degree, 1 to FLIP_PPD_MAX */
};

struct comparison_layer {
    char name[IMAGE_NAME_SIZE];
    struct difference difference;
};

/* The differences that are one number and may have a limit. */
enum comparison_metric {
    COMPARISON_FLIP,   /* mean, of beauty */
    COMPARISON_RMSE,   /* of beauty */
    COMPARISON_RELMSE, /* of beauty */
    COMPARISON_MAE,    /* of beauty, clipped to 0 and 1 */
    COMPARISON_ANGLE,  /* mean of the layer exit, degrees */
    COMPARISON_METRIC_COUNT,
};

extern const char *const comparison_metric_names[COMPARISON_METRIC_COUNT];

struct comparison {
    size_t counted; /* pixels */
    bool has_beauty;
    double flip;                     /* mean */
    bool is_hdr;                     /* `flip` is HDR-FLIP */
    struct flip_exposures exposures; /* of HDR-FLIP */
    float *errors;                   /* FLIP of each pixel, 0 if it is not counted; or NULL */
    bool has_exit;                   /* both images have exit.X, .Y and .Z */
    struct angle angle;              /* of the layer exit */
    float *degrees;                  /* of angle_measure(); or NULL */
    bool has_tir;                    /* both images have the layer tir */
    uint64_t tir_differs, tir_count; /* pixels of different tir; pixels with an exit in either */
    struct comparison_layer *layers; /* beauty first, then in the reference's order */
    uint32_t layer_count;
    const char **only_reference, **only_test; /* names of planes, borrowed from the images */
    uint32_t only_reference_count, only_test_count;
};

/* Compares the images. Returns false when out of memory; *comparison is then {0}. */
bool comparison_init(struct comparison *comparison, const struct comparison_params *params);

void comparison_finish(struct comparison *comparison);

/* Returns the layer of that name, or NULL. */
const struct comparison_layer *comparison_find(const struct comparison *comparison,
                                               const char *name);

/*
 * Returns the layer that a metric measures, or NULL if an image lacks it. *value is the metric, NaN
 * if no pixel is counted.
 */
const struct comparison_layer *comparison_metric(const struct comparison *comparison,
                                                 enum comparison_metric metric, double *value);

#endif
