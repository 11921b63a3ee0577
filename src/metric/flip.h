/*
 * flip.h: FLIP, a metric of the differences that people see when they flip between two images.
 *
 * LDR-FLIP follows the paper cited in flip_color.h, HDR-FLIP that of flip_tone.h. Filters and
 * colours are computed in float, as in the authors' programs.
 */
#ifndef FIRN_METRIC_FLIP_H
#define FIRN_METRIC_FLIP_H

#include <stdbool.h>
#include <stdint.h>
#include "src/metric/flip_tone.h"

/* Pixels per degree of a screen that is 0.7 m wide, has 3840 columns and is 0.7 m away: the
 * authors' default. */
#define FLIP_PPD 67.0206432765823

/* Linear R, G and B of two images. A pixel that is not finite in either has the error 1. */
struct flip_pair {
    uint32_t width, height;
    const float *reference[3], *test[3];
    double ppd; /* pixels per degree, 1 to FLIP_PPD_MAX */
};

/*
 * Computes the LDR-FLIP of both images, multiplied by 2^exposure and clamped to a display's range:
 * width * height errors, from 0 to 1. Returns false when out of memory.
 */
bool flip_ldr(const struct flip_pair *pair, double exposure, float *errors);

/* Computes the HDR-FLIP: the greatest LDR-FLIP of each pixel over the exposures that the reference
 * determines, which are returned in *exposures. Returns false when out of memory. */
bool flip_hdr(const struct flip_pair *pair, enum flip_curve curve, float *errors,
              struct flip_exposures *exposures);

#endif
