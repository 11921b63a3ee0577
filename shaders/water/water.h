/* water.h: parameters of waves and pool, shared by water.c, caustics.c and their shaders. */
#ifndef SHADERS_WATER_WATER_H
#define SHADERS_WATER_WATER_H
#include "abi.h"

#define WATER_ENVIRONMENT 1 /* equirectangular map, -Z in the middle */
#define WATER_CAUSTICS    6 /* caustics_light, in water_caustics*.frag */

#define WATER_GRID 128 /* surface grid cells per side */

#define WATER_SERIES 0 /* values of water_params.wave */
#define WATER_COSINE 1

/* Waves and optical properties of the water. Lengths of the wave series are in units of `scale`. */
struct water_params {
    uint32_t wave;          /* WATER_SERIES, ... */
    float height;           /* series: V; cosine: amplitude */
    float frequency;        /* series: W; cosine: wave number */
    float amplitude;        /* series: F of the first octave */
    float speed;            /* S: angular frequency, radians per second */
    uint32_t octaves;       /* series: number of octaves */
    float scale;            /* metres per unit of the series */
    float ior;              /* refractive index; shaders: relative to air */
    float red, green, blue; /* absorption coefficients, 1 / metre */
};

/* A square, axis-aligned box of water centred on the origin; the water at rest is at height 0. */
struct pool_params {
    uint32_t water; /* 1: the pool replaces the object */
    float size;     /* side length, metres */
    float depth;    /* metres */
    float tile;     /* side length of a tile, metres */
    float ice;      /* width of the floating ice, metres; 0 if there is none */
};

#define POOL_RIM   0.2f                   /* height of the rim above the water at rest, metres */
#define POOL_STONE 0.560f, 0.520f, 0.460f /* albedo of the dry parts */

struct water_push {
    ABI_STRUCT(water_params) water;
    ABI_STRUCT(pool_params) pool;
};

#endif
