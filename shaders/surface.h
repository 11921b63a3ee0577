/* surface.h: what surface.c and surface.glsl agree on. */
#ifndef SHADERS_SURFACE_H
#define SHADERS_SURFACE_H
#include "abi.h"

/* of globals */
struct surface_params {
    float
        strength; /* radiance at the middle of a light's highlight, if the light's strength is 1 */
    float shininess; /* exponent of the cosine around the mirror's direction */
};

#endif
