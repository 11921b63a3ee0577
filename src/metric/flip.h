/*
 * flip.h: the FLIP image metric: the error that people perceive when alternating between images.
 *
 * RMSE weights invisible noise like visible structure. FLIP instead filters both images by the
 * contrast sensitivity of the eye at a viewing distance, compares colours in a perceptually uniform
 * space, and amplifies errors at edges and points. LDR-FLIP follows the paper cited in
 * flip_color.h; HDR-FLIP, the paper cited in flip_tone.h, takes the maximum over a range of
 * exposures. Computed in single precision, as in the authors' code.
 */
#ifndef FIRN_METRIC_FLIP_H
#define FIRN_METRIC_FLIP_H

#include <stdbool.h>
#include <stdint.h>
#include "src/metric/flip_tone.h"

/* Default pixels per degree of the authors: a screen 0.7 m wide, 3840 columns, seen from 0.7 m. */
#define FLIP_PPD 67.0206432765823

/* Linear R, G and B of two images. A pixel that is not finite in either image has the error 1. */
struct flip_pair {
    uint32_t width, height;
    const float *reference[3], *test[3];
    double ppd; /* pixels per degree of visual angle, 1 to FLIP_PPD_MAX */
};

/*
 * Computes the LDR-FLIP error map of both images, multiplied by 2^exposure and clamped to the
 * display range. errors[] receives width * height values, 0 to 1. Returns false when out of memory.
 */
bool flip_ldr(const struct flip_pair *pair, double exposure, float *errors);

/* Computes the HDR-FLIP error map: the maximum LDR-FLIP error of each pixel over a range of
 * exposures, which the reference determines. Returns false when out of memory. */
bool flip_hdr(const struct flip_pair *pair, enum flip_curve curve, float *errors,
              struct flip_exposures *exposures);

#endif
