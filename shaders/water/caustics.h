/* caustics.h: constants and push constants of caustics.c and caustics*.{glsl,vert,frag,comp}. */
#ifndef SHADERS_WATER_CAUSTICS_H
#define SHADERS_WATER_CAUSTICS_H
#include "water/water.h"

#define CAUSTICS_NONE      0 /* values of caustics_params.method */
#define CAUSTICS_NAIVE     1
#define CAUSTICS_GATHER    2
#define CAUSTICS_BACKTRACE 3
#define CAUSTICS_AREA      4

#define CAUSTICS_SNELL     0 /* values of caustics_params.slope */
#define CAUSTICS_PUBLISHED 1

#define CAUSTICS_SIZE 512 /* side of the light map, texels */
#define CAUSTICS_GRID 256 /* method `area`: cells along each side of the surface grid */

#define CAUSTICS_GROUP_2D     8       /* workgroup width and height */
#define CAUSTICS_GROUP_1D     256     /* size of one-dimensional workgroups */
#define CAUSTICS_WEIGHT       1024.0f /* weight of a photon at normal incidence */
#define CAUSTICS_TRIANGLE_MAX 32.0f   /* maximum light that one triangle adds to a texel */

#define CAUSTICS_COUNTS  1 /* accumulated photon weights, in units of 1 / CAUSTICS_WEIGHT */
#define CAUSTICS_RAW     1 /* light map before filtering */
#define CAUSTICS_SUM     2 /* sum of the light map's texels */
#define CAUSTICS_LANDING 1 /* landing points of the grid's vertices on the floor, and their flux */

struct caustics_params {
    uint32_t method;     /* CAUSTICS_NONE, ... */
    float sun;           /* angular diameter of the sun, degrees */
    uint32_t photons;    /* naive: number of photons */
    uint32_t directions; /* gather: directions per floor point */
    float cone;     /* gather: half-angle of the cone around the sun ray in level water, degrees */
    uint32_t slope; /* backtrace: CAUSTICS_SNELL, ... */
    float glow; /* backtrace: angular radius at which the sun's glow has fallen to 1 / e, degrees */
};

struct caustics_push {
    ABI_STRUCT(water_params) water;
    ABI_STRUCT(pool_params) pool;
    ABI_STRUCT(caustics_params) caustics;
};

#endif
