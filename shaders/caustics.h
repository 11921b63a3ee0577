/* caustics.h: what caustics.c and caustics*.{glsl,vert,frag,comp} agree on. */
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
#define CAUSTICS_LINE   256 /* in a workgroup of photons, and in the one that adds up */
#define CAUSTICS_WEIGHT 1024.0f /* that a photon on level water counts */
#define CAUSTICS_MOST   32.0f   /* light that a triangle brings to a texel at most */

#define CAUSTICS_COUNTS  1 /* light of photons, in CAUSTICS_WEIGHT */
#define CAUSTICS_RAW     1 /* light before it is spread or evened out */
#define CAUSTICS_SUM     2 /* of the whole map */
#define CAUSTICS_LANDING 1 /* where the grid's corners are on the floor, and their flux */

struct caustics_params {
    uint32_t method;     /* CAUSTICS_NONE ... */
    float sun;           /* its diameter, degrees */
    uint32_t photons;    /* naive */
    uint32_t directions; /* gather: from each point of the floor */
    float cone;          /* gather: where they go, degrees from the straight ray */
    uint32_t slope;      /* backtrace: CAUSTICS_SNELL ... */
    float glow;          /* backtrace: how far from its middle the light's map has faded, degrees */
};

struct caustics_push {
    ABI_STRUCT(water_params) water;
    ABI_STRUCT(pool_params) pool;
    ABI_STRUCT(caustics_params) caustics;
};

#endif
