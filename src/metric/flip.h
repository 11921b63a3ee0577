/*
 * flip.h: FLIP, the errors that people see who flip between two pictures.
 *
 * LDR-FLIP as the paper of flip_color.h says, HDR-FLIP as that of flip_tone.h. Filters and colours
 * are in float, as in the authors' own programs.
 */
#ifndef FIRN_METRIC_FLIP_H
#define FIRN_METRIC_FLIP_H

#include <stdbool.h>
#include <stdint.h>
#include "src/metric/flip_tone.h"

/* Pixels a degree of a screen 0.7 m wide with 3840 of them, 0.7 m away; the authors' default. */
#define FLIP_PPD 67.0206432765823

/* Linear R, G and B. A pixel with a number that is not finite, in either, has the error 1. */
struct flip_pair {
    uint32_t width, height;
    const float *reference[3], *test[3];
    double ppd; /* pixels per degree, 1 to FLIP_PPD_MAX */
};

/*
 * The errors of both pictures, doubled in light `exposure` times and clamped to what a display
 * shows: width * height of them, from 0 to 1. False: memory is short; as below.
 */
bool flip_ldr(const struct flip_pair *pair, double exposure, float *errors);

/* The greatest LDR-FLIP of each pixel in all exposures that the reference asks for. */
bool flip_hdr(const struct flip_pair *pair, enum flip_curve curve, float *errors,
              struct flip_exposures *exposures);

#endif
