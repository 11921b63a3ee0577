/* refract_blend.h: what refract_blend.c and refract_blend.frag agree on. */
#ifndef SHADERS_REFRACT_BLEND_H
#define SHADERS_REFRACT_BLEND_H
#include "refract.h"

struct refract_blend_params {
    float a; /* share of the back face's normal */
};

#endif
