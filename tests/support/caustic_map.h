/* caustic_map.h: computes the caustic map of a pool's floor with a given method. */
#ifndef TESTS_SUPPORT_CAUSTIC_MAP_H
#define TESTS_SUPPORT_CAUSTIC_MAP_H

#include "shaders/water/caustics.h"
#include "src/gpu/gpu.h"

enum {
    CAUSTIC_MAP_SIZE = CAUSTICS_SIZE, /* width and height, texels */
    CAUSTIC_MAP_COUNT = CAUSTIC_MAP_SIZE * CAUSTIC_MAP_SIZE,
};

struct caustic_map_params {
    const char *method;
    double elevation;               /* sun elevation, degrees; the sun is in direction +x */
    const char *const *assignments; /* settings "name=value"; NULL-terminated */
    uint32_t run_count;             /* number of timed runs; 0 means 1 */
};

struct light_map {
    float *texels;      /* texels of the map, row-major from the lowest x and y */
    double size, depth; /* of the pool, metres */
    double lower[2];    /* corner of lowest x and y, in pool coordinates */
    double texel[2];    /* extent of a texel, metres */
    double shift_x;     /* horizontal shift of refracted sunlight at the floor, metres */
    double total;       /* fraction of the light entering the pool that reaches the map */
    double ms;          /* host time of the fastest run, readback included, milliseconds */
};

/* Traces the caustic map; the caller frees `texels`. Any failure fails the test. */
struct light_map caustic_map_trace(struct gpu *gpu, const struct caustic_map_params *params);

/* Returns the pool coordinate of a texel's centre along axis 0 (x) or 1 (y). */
double caustic_map_position(const struct light_map *map, size_t axis, size_t index);

#endif
