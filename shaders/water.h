/* water.h: shared by water.c, caustics.c and their shaders: the waves and the pool. */
#ifndef SHADERS_WATER_H
#define SHADERS_WATER_H
#include "abi.h"

#define WATER_ENVIRONMENT 1 /* equirectangular picture, -Z in the middle */
#define WATER_CAUSTICS    6 /* caustics_light; water_caustics*.frag */

#define WATER_GRID 128 /* cells of the drawn surface along each side */

#define WATER_SERIES 0 /* water_params.wave */
#define WATER_COSINE 1

/* Waves and optical properties of the water. Lengths of the series are in units of `scale`. */
struct water_params {
    uint32_t wave;          /* WATER_SERIES ... */
    float height;           /* of the series: V; of the cosine: its amplitude */
    float frequency;        /* of the series: W; of the cosine: its wave number */
    float amplitude;        /* F of the series' first octave */
    float speed;            /* S: phase, radians per second */
    uint32_t octaves;       /* of the series */
    float scale;            /* metres per unit */
    float ior;              /* refractive index; in shaders, relative to that of air */
    float red, green, blue; /* absorption coefficients, 1 / metre */
};

/* A square box of water around the origin, its sides along the axes, at rest at height 0. */
struct pool_params {
    uint32_t water; /* 1: the pool replaces the object */
    float size;     /* side length, metres */
    float depth;    /* metres */
    float tile;     /* side length of a tile, metres */
    float ice;      /* width of the floating ice, metres; 0: none */
};

#define POOL_RIM   0.2f                   /* height of the rim above the water at rest, metres */
#define POOL_STONE 0.560f, 0.520f, 0.460f /* colour of the dry parts */

struct water_push {
    ABI_STRUCT(water_params) water;
    ABI_STRUCT(pool_params) pool;
};

#endif
