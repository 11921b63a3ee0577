/* ao.h: uniforms and bindings of ambient occlusion (ao.c, ao_box_occluders.frag, lib/ao.glsl). */
#ifndef SHADERS_LIGHTING_AO_H
#define SHADERS_LIGHTING_AO_H
#include "abi.h"

/* Bindings; the others belong to surroundings.h. */
#define AO_BINDING    13 /* struct ao_occluders */
#define AO_MAP        14 /* occlusion map: change in irradiance on the plane below the objects */
#define AO_HEIGHTS    15 /* heights of the surroundings above the objects' base, 0 to 1 */
#define AO_UNDERSIDES 16 /* height of surroundings' lowest underside; 1 if there is none */

#define AO_OCCLUDERS_MAX 4     /* maximum number of occluders */
#define AO_MAP_SIZE      128   /* side of the occlusion map, texels */
#define AO_HEIGHTS_SIZE  256   /* side of the height fields, texels */
#define AO_HEIGHTS_RANGE 3.0f  /* range of the height fields, in units of ao_occluders.height */
#define AO_HEIGHTS_GAP   0.01f /* minimum height, relative to AO_HEIGHTS_RANGE */

/* Box that occludes environment light. The box passes on to the ground around it the fraction `sky`
 * of sky light and the fraction `ground` of ground light. */
struct ao_occluder {
    vec3s min, max; /* box corners, object space, metres */
    vec3s sky, ground;
    float undeviated; /* fraction of the transmitted sky light whose direction hardly changes */
};

struct ao_occluders {
    ABI_STRUCT(ao_occluder) all[AO_OCCLUDERS_MAX];
    uint32_t count;
    float strength;  /* 0: no effect; 1: full occlusion */
    vec3s center;    /* centre of the map at the height of the objects' base, world, metres */
    float half_side; /* half the map's side, metres */
    float height;    /* height above the objects' base beyond which nothing is occluded, metres */
};

#endif
