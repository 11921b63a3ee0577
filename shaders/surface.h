/* surface.h: what surface.c, surface.glsl and surface.frag agree on. */
#ifndef SHADERS_SURFACE_H
#define SHADERS_SURFACE_H
#include "abi.h"

#define SURFACE_HIGHLIGHTS 1 /* what the rung wrote */

/* of globals */
struct surface_params {
    float
        strength; /* radiance at the middle of a light's highlight, if the light's strength is 1 */
    float shininess; /* exponent of the cosine around the mirror's direction */
};

#endif
