/* air.h: bindings and push constants of air.{vert,frag}; bindings 1 and 2 belong to ice_depth.h. */
#ifndef SHADERS_INCLUSIONS_AIR_H
#define SHADERS_INCLUSIONS_AIR_H
#include "abi.h"

#define AIR_LAYERS 3 /* texture array of opacities; r: bubbles, g: haze */

/* Cosine between view ray and an air plane's normal below which the plane fades out. */
#define AIR_EDGE 0.3f

struct air_push {
    float strength; /* maximum opacity of a bubble */
    float haze;     /* maximum opacity of the haze */
};

#endif
