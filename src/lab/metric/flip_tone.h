/*
 * flip_tone.h: tone curves and exposures of HDR-FLIP.
 *
 * Andersson, Nilsson, Shirley, Akenine-Moeller: Visualizing Errors in Rendered High Dynamic Range
 * Images. Eurographics 2021: section 3. Tone curves: K. Narkowicz, ACES filmic tone mapping curve,
 * 2016; J. Hable, Filmic tonemapping operators, 2010; E. Reinhard et al., Photographic tone
 * reproduction for digital images, SIGGRAPH 2002, eq. 3, applied to luminance.
 */
#ifndef FIRN_LAB_METRIC_FLIP_TONE_H
#define FIRN_LAB_METRIC_FLIP_TONE_H

#include <cglm/types-struct.h>
#include <stdint.h>

enum flip_curve {
    FLIP_ACES, /* the default of the paper */
    FLIP_HABLE,
    FLIP_REINHARD,
    FLIP_CURVE_COUNT,
};

extern const char *const flip_curve_names[FLIP_CURVE_COUNT + 1]; /* terminated by NULL */

/* Returns the luminance of a linear Rec.709 colour. */
float flip_tone_luminance(vec3s linear);

/* Tone-maps a nonnegative linear colour to a linear colour from 0 to 1. */
vec3s flip_tone(enum flip_curve curve, vec3s linear);

/* Returns the scene value that the tone curve maps to the display value `shown`, 0 to 1. */
double flip_tone_inverse(enum flip_curve curve, double shown);

struct flip_exposures {
    double first, last;
    uint32_t count; /* at least 2, equally spaced */
};

/*
 * Returns HDR-FLIP's exposure range. The tone curve maps the maximum luminance to 0.85 at the first
 * exposure, and the median luminance to 0.85 at the last exposure. If the reference is black, both
 * exposures are 0 stops.
 */
struct flip_exposures flip_tone_exposures(enum flip_curve curve, double luminance_max,
                                          double median);

#endif
