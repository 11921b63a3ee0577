/* refract_bounce.h: what refract_bounce.c and refract_exits.glsl agree on. */
#ifndef SHADERS_REFRACT_BOUNCE_H
#define SHADERS_REFRACT_BOUNCE_H
#include "refract_march.h"

/* refract_bounce_params.nested */
#define REFRACT_BOUNCE_NESTED_OFF 0
#define REFRACT_BOUNCE_NESTED_ON  1 /* where objects are in others, hollow or folded (fold.h) */
#define REFRACT_BOUNCE_NESTED_ALL 2 /* and where an object is concave at all */

/* refract_bounce_params.bent: along rays that the object's surface has bent, not straight ones. */
#define REFRACT_BOUNCE_BENT_OFF    0
#define REFRACT_BOUNCE_BENT_CRACKS 1 /* gaps of air, which mirror what is in the object */
#define REFRACT_BOUNCE_BENT_ALL    2 /* and bubbles; cracks by reflected rays, too */

struct refract_bounce_params {
    ABI_STRUCT(refract_march) march;
    uint32_t exits; /* faces through which a ray's light leaves, at most */
    float least;    /* share of a ray's light that is followed beyond its first exit, at least */
    float branch;   /* share of a pixel's light that a crack parts and that is followed, at least */
    uint32_t margin; /* 1: the wide maps are read where the object leaves the picture */
    uint32_t nested; /* REFRACT_BOUNCE_NESTED_OFF ...: where the maps of ice_nested.h are read */
    uint32_t bent;   /* REFRACT_BOUNCE_BENT_OFF ...: what is met along bent rays */
};

#endif
