/* light_map.h: computes the light map of a pool's floor by one method. */
#ifndef TESTS_LIGHT_MAP_H
#define TESTS_LIGHT_MAP_H

#include "shaders/water/caustics.h"
#include "src/gpu/gpu.h"

enum {
    LIGHT_MAP_SIZE = CAUSTICS_SIZE, /* texels a side */
    LIGHT_MAP_COUNT = LIGHT_MAP_SIZE * LIGHT_MAP_SIZE,
};

struct light_map_params {
    const char *method;
    double elevation;               /* of the sun, which stands on +x; degrees */
    const char *const *assignments; /* settings; end at NULL */
    uint32_t run_count;             /* 0 means 1 */
};

struct light_map {
    float *texels;      /* rows from the lowest y, each from the lowest x */
    double size, depth; /* of the pool, metres */
    double lower[2];    /* corner of the map, pool coordinates */
    double texel[2];    /* lengths of a texel's sides, metres */
    double shift_x;     /* of the light on the floor */
    double total;       /* light over what enters the pool */
    double ms;          /* of the fastest run, by the host's clock, with its way back */
};

/* The caller frees its texels. Any failure fails the test. */
struct light_map light_map_trace(struct gpu *gpu, const struct light_map_params *params);

/* Of a texel's middle, along axis 0 or 1. */
double light_map_place(const struct light_map *map, size_t axis, size_t index);

#endif
