/* water.h: what water.c, caustics.c and their shaders agree on: waves and the pool they are in. */
#ifndef SHADERS_WATER_H
#define SHADERS_WATER_H
#include "abi.h"

#define WATER_ENVIRONMENT 1 /* equirectangular picture, -Z in the middle */
#define WATER_CAUSTICS    6 /* caustics_light; water_caustics*.frag */

#define WATER_GRID 128 /* cells of the drawn surface along each side */

#define WATER_SERIES 0 /* water_params.wave */
#define WATER_COSINE 1

/* Waves, and the matter that has them. Lengths of the series are in units of `scale`. */
struct water_params {
    uint32_t wave;          /* WATER_SERIES ... */
    float height;           /* of the series: V; of the cosine: its amplitude */
    float frequency;        /* of the series: W; of the cosine: its wave number */
    float amplitude;        /* F of the series' first octave */
    float speed;            /* S: phase, radians a second */
    uint32_t octaves;       /* of the series */
    float scale;            /* metres a unit */
    float ior;              /* refractive index; for shaders, over that of air */
    float red, green, blue; /* absorption, 1 / metres */
};

/* A square box of water around the origin, its sides along the axes, at rest at height 0. */
struct pool_params {
    uint32_t water; /* 1: drawn in place of the object */
    float size;     /* metres a side */
    float depth;    /* metres */
    float tile;     /* metres a side */
    float ice;      /* width of what floats in it, metres; 0: nothing */
};

#define POOL_RIM   0.2f                   /* height of the rim above the water at rest, metres */
#define POOL_STONE 0.560f, 0.520f, 0.460f /* colour of what is dry */

struct water_push {
    ABI_STRUCT(water_params) water;
    ABI_STRUCT(pool_params) pool;
};

#endif
