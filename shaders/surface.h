/* surface.h: parameters of the light sources' highlights, shared by surface.c and surface.glsl. */
#ifndef SHADERS_SURFACE_H
#define SHADERS_SURFACE_H
#include "abi.h"

/* member of struct globals */
struct surface_params {
    float strength;  /* peak radiance of the highlight of a light of strength 1 */
    float shininess; /* Blinn-Phong exponent */
};

#endif
