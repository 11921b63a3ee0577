/* refract_bounce.h: push constants of the refraction model with internal reflections
 * (refract_bounce.c, refract_exits.glsl). */
#ifndef SHADERS_REFRACT_REFRACT_BOUNCE_H
#define SHADERS_REFRACT_REFRACT_BOUNCE_H
#include "refract/refract_march.h"

/* values of refract_bounce_params.nested */
#define REFRACT_BOUNCE_NESTED_OFF 0
#define REFRACT_BOUNCE_NESTED_ON \
    1 /* for nested objects, cavities and folds (mesh_depth_complexity.h) */
#define REFRACT_BOUNCE_NESTED_ALL 2 /* also for all concave objects */

/* values of refract_bounce_params.bent: which inclusions are intersected along refracted rays */
#define REFRACT_BOUNCE_INCLUSIONS_OFF 0
#define REFRACT_BOUNCE_INCLUSIONS_CRACKS \
    1                                   /* only cracks, air gaps that reflect the object's inside */
#define REFRACT_BOUNCE_INCLUSIONS_ALL 2 /* cracks, also along reflected rays, and bubbles */

struct refract_bounce_params {
    ABI_STRUCT(refract_march) march;
    uint32_t exits;      /* maximum number of faces through which light of a ray leaves */
    float least;         /* minimum fraction of a ray's light to follow it beyond its first exit */
    float branch;        /* minimum throughput to follow both directions at a crack */
    uint32_t margin;     /* 1 to read maps wider than the image where the object leaves the image */
    uint32_t nested;     /* REFRACT_BOUNCE_NESTED_OFF ...: use of depth layers (ice_nested.h) */
    uint32_t inclusions; /* REFRACT_BOUNCE_INCLUSIONS_OFF ...: inclusions that refracted rays hit */
};

#endif
