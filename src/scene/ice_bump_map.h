/*
 * ice_bump_map.h: generates a tileable bump map of an ice surface. The map stores the slopes of a
 * height field of dimples, like those of melting ice, and of fractal noise. Another noise field
 * selects smooth regions. Results are bit-identical on every machine.
 */
#ifndef FIRN_SCENE_ICE_BUMP_MAP_H
#define FIRN_SCENE_ICE_BUMP_MAP_H

#include <stdbool.h>
#include <stdint.h>

enum {
    BUMP_MAPS_SIZE = 512, /* width and height in texels */
};

struct bump_maps {
    /* half RGBA texels of all mip levels (mip_levels.h): r and g are slopes along u and v, with a
     * root mean square of 1; b is surface smoothness; a is frost thickness, 0 to 1 */
    uint16_t *texels;
    uint32_t size; /* width and height in texels; 0 if there is no texture */
};

struct bump_maps_params {
    float smooth; /* smooth fraction of the surface */
    uint32_t seed;
    /* height map, BUMP_MAPS_SIZE rows and columns; NULL for the procedural one */
    const float *heights;
    const float *smoothness; /* smoothness map, 0 to 1; NULL for the procedural one */
};

/* Generates the bump map. Returns false when out of memory; *maps is then zeroed. */
bool bump_maps_init(struct bump_maps *maps, const struct bump_maps_params *params);

void bump_maps_finish(struct bump_maps *maps);

#endif
