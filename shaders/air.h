/* air.h: shared by air.c and air.{vert,frag}; bindings 1 and 2 are those of ice_depth.h. */
#ifndef SHADERS_AIR_H
#define SHADERS_AIR_H
#include "abi.h"

#define AIR_LAYERS 3 /* opacities: red of bubbles, green of haze */

/* Cosine between a plane's normal and the ray below which the plane fades out, because it would be
 * a line when seen edge on. */
#define AIR_EDGE 0.3f

struct air_push {
    float strength; /* opacity of a bubble at most */
    float haze;     /* opacity of the haze at most */
};

#endif
