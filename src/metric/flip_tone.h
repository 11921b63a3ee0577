/*
 * flip_tone.h: the tone curves and exposures with which HDR-FLIP displays an image.
 *
 * Andersson, Nilsson, Shirley, Akenine-Moeller: Visualizing Errors in Rendered High Dynamic Range
 * Images. Eurographics 2021: section 3. The curves: K. Narkowicz, ACES filmic tone mapping curve,
 * 2016; J. Hable, Filmic tonemapping operators, 2010; E. Reinhard and others, Photographic tone
 * reproduction for digital images, SIGGRAPH 2002, eq. 3, of luminance.
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

/* Maps linear colours, which must not be negative, to linear ones from 0 to 1. */
vec3s flip_tone(enum flip_curve curve, vec3s linear);

/* Returns the value that the curve maps to `shown`, which is between 0 and 1. */
double flip_tone_inverse(enum flip_curve curve, double shown);

/* A range of exposures, in stops. */
struct flip_exposures {
    double first, last;
    uint32_t count; /* at least 2, at equal distances */
};

/*
 * Returns the range between the exposures that map the greatest luminance and the median luminance
 * of the reference to 0.85. A black reference has 0 stops.
 */
struct flip_exposures flip_tone_exposures(enum flip_curve curve, double greatest, double median);

#endif
