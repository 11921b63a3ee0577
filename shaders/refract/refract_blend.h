/* refract_blend.h: push constants of the blended-normals refraction model (refract_blend.c). */
#ifndef SHADERS_REFRACT_REFRACT_BLEND_H
#define SHADERS_REFRACT_REFRACT_BLEND_H
#include "refract/refract.h"

struct refract_blend_params {
    float a; /* weight of the back face's normal */
};

#endif
