/* surface.h: shared by surface.c and surface.glsl. */
#ifndef SHADERS_SURFACE_H
#define SHADERS_SURFACE_H
#include "abi.h"

/* of globals */
struct surface_params {
    float strength;  /* radiance at the middle of the highlight of a light of strength 1 */
    float shininess; /* exponent of the cosine around the mirror's direction */
};

#endif
