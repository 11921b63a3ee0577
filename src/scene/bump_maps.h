/*
 * bump_maps.h: procedural, tileable bump map of an ice surface.
 *
 * It stores the slopes of a height field: dimples, as melting leaves them, and octaves of noise.
 * Another noise selects smooth regions. Results are bit-identical on every machine.
 *
 * Ownership: bump_maps_finish() frees the texels; {0} is fine.
 */
#ifndef FIRN_SCENE_BUMP_MAPS_H
#define FIRN_SCENE_BUMP_MAPS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    BUMP_MAPS_SIZE = 512, /* width and height in texels */
};

struct bump_maps {
    /* half RGBA: slopes along u and v, with a root mean square of 1; smoothness of the surface;
     * thickness of its frost, 0 to 1. All mip levels, in the layout of mip_levels.h. */
    uint16_t *texels;
    uint32_t size; /* width and height of the first level; 0 if there is no texture */
};

struct bump_maps_params {
    float smooth; /* fraction of the surface that is smooth */
    uint32_t seed;
    const float *heights; /* replaces the procedural height field; BUMP_MAPS_SIZE rows; or NULL */
    const float *smoothness; /* smoothness, 0 to 1, that replaces `smooth`; or NULL */
};

/* Generates the texture. Returns false when out of memory; *maps is then {0}. */
bool bump_maps_init(struct bump_maps *maps, const struct bump_maps_params *params);

void bump_maps_finish(struct bump_maps *maps);

#endif
