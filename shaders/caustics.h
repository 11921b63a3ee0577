/* caustics.h: shared by caustics.c and caustics*.{glsl,vert,frag,comp}. */
#ifndef SHADERS_CAUSTICS_H
#define SHADERS_CAUSTICS_H
#include "water.h"

#define CAUSTICS_NONE      0 /* caustics_params.method */
#define CAUSTICS_NAIVE     1
#define CAUSTICS_GATHER    2
#define CAUSTICS_BACKTRACE 3
#define CAUSTICS_AREA      4

#define CAUSTICS_SNELL     0 /* caustics_params.slope */
#define CAUSTICS_PUBLISHED 1

#define CAUSTICS_SIZE 512 /* texels along each side of the map */
#define CAUSTICS_GRID 256 /* cells of the surface along each side, of the area method */

#define CAUSTICS_GROUP  8   /* invocations along each side of a workgroup of the map or the grid */
#define CAUSTICS_LINE   256 /* invocations of a workgroup of photons, and of caustics_sum.comp */
#define CAUSTICS_WEIGHT 1024.0f /* integer weight of a photon that enters level water */
#define CAUSTICS_MOST   32.0f   /* greatest light of a triangle in a texel */

#define CAUSTICS_COUNTS  1 /* light of photons, in units of 1 / CAUSTICS_WEIGHT */
#define CAUSTICS_RAW     1 /* light before it is blurred or normalised */
#define CAUSTICS_SUM     2 /* sum of the whole map */
#define CAUSTICS_LANDING 1 /* positions of the grid's corners on the floor, and their flux */

struct caustics_params {
    uint32_t method;     /* CAUSTICS_NONE ... */
    float sun;           /* diameter of the sun, degrees */
    uint32_t photons;    /* naive: number of photons */
    uint32_t directions; /* gather: number of directions from each point of the floor */
    float cone;          /* gather: greatest angle of a direction with the straight ray, degrees */
    uint32_t slope;      /* backtrace: CAUSTICS_SNELL ... */
    float glow;          /* backtrace: angle at which the light map has faded out, degrees */
};

struct caustics_push {
    ABI_STRUCT(water_params) water;
    ABI_STRUCT(pool_params) pool;
    ABI_STRUCT(caustics_params) caustics;
};

#endif
