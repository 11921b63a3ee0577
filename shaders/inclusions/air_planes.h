/* air_planes.h: binding and push constants of air.{vert,frag}. */
#ifndef SHADERS_INCLUSIONS_AIR_PLANES_H
#define SHADERS_INCLUSIONS_AIR_PLANES_H
#include "abi.h"

#define AIR_LAYERS 3 /* texture array with the opacity of bubbles in r and of haze in g */

/* Air planes fade out where the cosine between their normal and the view ray is below this. */
#define AIR_EDGE 0.3f

struct air_push {
    float strength; /* maximum opacity of a bubble */
    float haze;     /* maximum opacity of the haze */
};

#endif
