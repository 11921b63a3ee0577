/*
 * alps.h: the height field of alps.exr: mountains around a lake, from noise and hydraulic erosion.
 *
 * Metres, x to the east, z to the south, y up. The camera is above the origin.
 */
#ifndef FIRN_ASSETS_ALPS_H
#define FIRN_ASSETS_ALPS_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>

#define ALPS_LAKE_SHORE 620.0F /* mean distance of the shore from the camera, metres */

/* A square height field centred on the origin. */
struct alps_grid {
    uint32_t side; /* nodes along one side */
    float width;   /* metres */
    float *heights;
    float *flow; /* accumulated flow of water, >= 0 */
};

struct alps {
    struct alps_grid inner, outer;
};

/* Returns false when out of memory; alps_free() frees what was allocated. */
bool alps_make(struct alps *alps, uint32_t side);
void alps_free(struct alps *alps);

/* Returns the height above the lake in metres; sets *flow to the accumulated flow of water. */
float alps_height(const struct alps *alps, float x, float z, float *flow);

/* Returns fractal value noise, -1 to 1, with octaves from `wavelength` (metres) downwards. */
float alps_noise(float x, float z, float wavelength, int octaves, uint32_t seed);

#endif
