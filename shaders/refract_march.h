/* refract_march.h: what refract_{search,bounce}.c and refract_march.glsl agree on. */
#ifndef SHADERS_REFRACT_MARCH_H
#define SHADERS_REFRACT_MARCH_H
#include "refract.h"

struct refract_march {
    uint32_t steps;    /* along a ray through the object's bounding sphere, until one is outside */
    uint32_t halvings; /* of the step that left the object */
    uint32_t bounces;  /* total reflections that are followed, at most */
};

#endif
