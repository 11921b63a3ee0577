/* refract_bounce.h: push constants of the refraction model with internal reflections. */
#ifndef SHADERS_REFRACT_REFRACT_BOUNCE_H
#define SHADERS_REFRACT_REFRACT_BOUNCE_H
#include "refract/refract_march.h"

/* values of refract_bounce_params.nested */
#define REFRACT_BOUNCE_NESTED_OFF 0
#define REFRACT_BOUNCE_NESTED_ON  1 /* nested objects, cavities and folds */
#define REFRACT_BOUNCE_NESTED_ALL 2 /* also for all concave objects */

/* Inclusions that refracted rays can hit: values of refract_bounce_params.inclusions. */
#define REFRACT_BOUNCE_INCLUSIONS_OFF    0
#define REFRACT_BOUNCE_INCLUSIONS_CRACKS 1 /* only cracks */
#define REFRACT_BOUNCE_INCLUSIONS_ALL    2 /* bubbles, and cracks along reflected rays */

struct refract_bounce_params {
    ABI_STRUCT(refract_march) march;
    uint32_t exits;       /* maximum number of exits per ray */
    float min_throughput; /* minimum throughput after the first exit */
    float branch;         /* minimum throughput to branch at cracks */
    uint32_t margin;      /* 1: maps extend beyond the image */
    uint32_t nested;      /* REFRACT_BOUNCE_NESTED_OFF ... */
    uint32_t inclusions;  /* REFRACT_BOUNCE_INCLUSIONS_OFF ... */
};

#endif
