/*
 * alps.h: mountains around a lake, for alps.c: a field of heights, made by noise, worn by water.
 *
 * Metres, x to the east, z to the south, y up. The eye is over the middle.
 */
#ifndef FIRN_ASSETS_ALPS_H
#define FIRN_ASSETS_ALPS_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>

#define ALPS_LAKE_SHORE 620.0F /* where the middle of the shore is, metres from the eye */

/* Square grids of heights around the middle. */
struct alps_grid {
    uint32_t side; /* nodes */
    float width;   /* metres */
    float *heights;
    float *flow; /* how much water has passed, 0 and more */
};

struct alps {
    struct alps_grid inner, outer;
};

/* Returns false when out of memory; alps_free() frees what there is. */
bool alps_make(struct alps *alps, uint32_t side);
void alps_free(struct alps *alps);

/* Returns the height at a place; *flow is what has passed there. */
float alps_height(const struct alps *alps, float x, float z, float *flow);

/* Noise of octaves from a wavelength down, about 0 in the mean and within -1 and 1. */
float alps_noise(float x, float z, float wavelength, int octaves, uint32_t seed);

#endif
