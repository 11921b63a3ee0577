/*
 * flip_tone.h: the tone curves and exposures at which HDR-FLIP compares images.
 *
 * Andersson, Nilsson, Shirley, Akenine-Moeller: Visualizing Errors in Rendered High Dynamic Range
 * Images. Eurographics 2021: section 3. Tone curves: K. Narkowicz, ACES filmic tone mapping curve,
 * 2016; J. Hable, Filmic tonemapping operators, 2010; E. Reinhard et al., Photographic tone
 * reproduction for digital images, SIGGRAPH 2002, eq. 3, applied to luminance.
 */
#ifndef FIRN_METRIC_FLIP_TONE_H
#define FIRN_METRIC_FLIP_TONE_H

#include <cglm/types-struct.h>
#include <stdint.h>

enum flip_curve {
    FLIP_ACES, /* the default of the paper */
    FLIP_HABLE,
    FLIP_REINHARD,
    FLIP_CURVE_COUNT,
};

extern const char *const flip_curve_names[FLIP_CURVE_COUNT];

/* Returns the luminance of a linear Rec.709 colour. */
float flip_tone_luminance(vec3s linear);

/* Tone-maps a linear colour, which must not be negative, to a linear colour from 0 to 1. */
vec3s flip_tone(enum flip_curve curve, vec3s linear);

/* Returns the scene value that the tone curve maps to `shown`, which must be between 0 and 1. */
double flip_tone_inverse(enum flip_curve curve, double shown);

/* A range of exposures, in stops. */
struct flip_exposures {
    double first, last;
    uint32_t count; /* number of exposures, at least 2, equally spaced */
};

/*
 * Returns the exposure range of HDR-FLIP. It starts where the tone curve maps the maximum luminance
 * of the reference to 0.85, and ends where it maps the median luminance to 0.85. For a black
 * reference both are 0 stops.
 */
struct flip_exposures flip_tone_exposures(enum flip_curve curve, double greatest, double median);

#endif
