/* highlight.h: parameters of the light sources' highlights (highlight.c, highlight.glsl). */
#ifndef SHADERS_LIGHTING_HIGHLIGHT_H
#define SHADERS_LIGHTING_HIGHLIGHT_H
#include "abi.h"

struct highlight_params {
    float strength;   /* radiance of a light with strength 1 */
    float shininess;  /* Blinn-Phong exponent */
    uint32_t fresnel; /* 1: highlights have the factor of Fresnel's equations; 0: factor 1 */
};

#endif
