/* air.h: what air.c and air.{vert,frag} agree on; 1 and 2 are ice_depth.h's. */
#ifndef SHADERS_AIR_H
#define SHADERS_AIR_H
#include "abi.h"

#define AIR_LAYERS 3 /* opacities: red of bubbles, green of haze */

/* Cosine between a plane's normal and the ray below which it fades: edge on it would be a line. */
#define AIR_EDGE 0.3

struct air_push {
    float strength; /* opacity of a bubble at most */
    float haze;     /* the same of the haze */
};

#endif
