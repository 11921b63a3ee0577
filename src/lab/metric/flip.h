/*
 * flip.h: the FLIP image metric: the error that people perceive when alternating between images.
 *
 * FLIP filters both images by the eye's contrast sensitivity at a viewing distance, compares
 * colours in a perceptually uniform space, and amplifies errors at edges and points. LDR-FLIP
 * follows the paper cited in flip_color.h; HDR-FLIP (flip_tone.h) takes the maximum over a range of
 * exposures. Computed in single precision, as in the authors' code.
 */
#ifndef FIRN_LAB_METRIC_FLIP_H
#define FIRN_LAB_METRIC_FLIP_H

#include <stdbool.h>
#include <stdint.h>
#include "src/lab/metric/flip_tone.h"

/* Pixels per degree of the FLIP paper's display: 3840 pixels over 0.7 m, seen from 0.7 m away. */
#define FLIP_PPD 67.0206432765823

/* Linear R, G, B planes of two images. Pixels that are not finite in either image have error 1. */
struct flip_pair {
    uint32_t width, height;
    const float *reference[3], *test[3];
    double ppd; /* pixels per degree, 1 to FLIP_PPD_MAX */
};

/*
 * Computes the LDR-FLIP error map of two images. Values are first multiplied by 2^exposure and
 * clamped to 0..1. errors[] receives width * height errors from 0 to 1. Returns false if out of
 * memory.
 */
bool flip_ldr(const struct flip_pair *pair, double exposure, float *errors);

/* Computes the HDR-FLIP error map: at each pixel, the maximum LDR-FLIP error of several exposures.
 * The reference determines *exposures. Returns false if out of memory. */
bool flip_hdr(const struct flip_pair *pair, enum flip_curve curve, float *errors,
              struct flip_exposures *exposures);

#endif
