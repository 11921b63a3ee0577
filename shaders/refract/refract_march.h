/* refract_march.h: parameters of the ray march inside the ice (refract_{search,bounce}.c). */
#ifndef SHADERS_REFRACT_REFRACT_MARCH_H
#define SHADERS_REFRACT_REFRACT_MARCH_H
#include "refract/refract.h"

struct refract_march {
    uint32_t steps;    /* steps through the bounding sphere */
    uint32_t halvings; /* bisections of the last step */
    uint32_t bounces;  /* maximum number of total internal reflections */
};

#endif
