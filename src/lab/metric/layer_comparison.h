/*
 * layer_comparison.h: compares two images layer by layer: FLIP, RMSE, relMSE, MAE, angles. A layer
 * is all planes whose names are equal up to the last dot. R, G and B are the layer "beauty". Planes
 * that exist in only one image are ignored.
 */
#ifndef FIRN_LAB_METRIC_LAYER_COMPARISON_H
#define FIRN_LAB_METRIC_LAYER_COMPARISON_H

#include "src/file/image.h"
#include "src/lab/metric/angle.h"
#include "src/lab/metric/error_sums.h"
#include "src/lab/metric/flip.h"

struct comparison_params {
    const struct image *reference, *test; /* must have the same size */
    const bool *counted;                  /* mask of pixels; NULL for all */
    bool display;                         /* display-referred: LDR-FLIP, else HDR-FLIP */
    bool has_exposure;                    /* always use LDR-FLIP, at `exposure` */
    double exposure;                      /* stops */
    enum flip_curve curve;                /* tone curve of HDR-FLIP */
    double ppd;                           /* pixels per degree, 1 to FLIP_PPD_MAX */
};

struct comparison_layer {
    char name[IMAGE_NAME_SIZE];
    struct difference difference;
};

/* Scalar metrics of a comparison, for which users can set limits. */
enum comparison_metric {
    COMPARISON_FLIP,   /* mean FLIP error of beauty */
    COMPARISON_RMSE,   /* root mean square error of beauty */
    COMPARISON_RELMSE, /* relative MSE of beauty */
    COMPARISON_MAE,    /* MAE of beauty, clamped to 0..1 */
    COMPARISON_ANGLE,  /* degrees, mean of the layer `exit` */
    COMPARISON_METRIC_COUNT,
};

extern const char *const comparison_metric_names[COMPARISON_METRIC_COUNT];

struct comparison {
    size_t counted; /* pixels in the mask */
    bool has_beauty;
    double flip;                     /* mean over the pixels */
    bool is_hdr;                     /* `flip` is HDR-FLIP */
    struct flip_exposures exposures; /* exposures used by HDR-FLIP */
    float *errors;                   /* per pixel; NULL without beauty */
    bool has_exit;                   /* both have exit.X, .Y and .Z */
    struct angle angle;              /* statistics of the layer `exit` */
    float *degrees;                  /* per pixel; NULL without `exit` */
    bool has_tir;                    /* both images have the layer `tir` */
    uint64_t tir_differs, tir_count; /* pixels whose `tir` differs; all */
    struct comparison_layer *layers; /* beauty first, then the reference's order */
    uint32_t layer_count;
    const char **only_reference, **only_test; /* borrowed names of unmatched planes */
    uint32_t only_reference_count, only_test_count;
};

/* Compares two images. When out of memory, returns false and zeroes *comparison. */
bool comparison_init(struct comparison *comparison, const struct comparison_params *params);

void comparison_finish(struct comparison *comparison);

/* Returns the layer of a given name, or NULL if there is none. */
const struct comparison_layer *comparison_find(const struct comparison *comparison,
                                               const char *name);

/*
 * Sets *value to a metric and returns the layer that the metric measures. If the mask contains no
 * pixel, *value is NaN. Returns NULL if an image lacks the layer.
 */
const struct comparison_layer *comparison_metric(const struct comparison *comparison,
                                                 enum comparison_metric metric, double *value);

#endif
