/* highlight.h: parameters of the light sources' highlights (highlight.c, highlight.glsl). */
#ifndef SHADERS_LIGHTING_HIGHLIGHT_H
#define SHADERS_LIGHTING_HIGHLIGHT_H
#include "abi.h"

struct highlight_params {
    float strength;  /* peak radiance of the highlight of a light with strength 1 */
    float shininess; /* Blinn-Phong exponent */
};

#endif
