/*
 * bump_maps.h: the uneven surface of ice as a procedural texture that repeats.
 *
 * The texture has the slopes of a height field: dimples, as melting leaves them, and several
 * octaves of noise. Another noise selects where the surface is smooth. Equal parameters give equal
 * bytes on every machine.
 *
 * Ownership: bump_maps_finish() frees the texels; {0} is fine.
 */
#ifndef FIRN_SCENE_BUMP_MAPS_H
#define FIRN_SCENE_BUMP_MAPS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    BUMP_MAPS_SIZE = 512, /* texels along each side */
};

struct bump_maps {
    uint16_t *texels; /* half, four a texel: slopes along u and v, whose root mean square is 1;
                         smoothness of the surface and thickness of its frost, 0 to 1; all mip
                         levels, as mips.h orders them */
    uint32_t size;    /* texels along each side of the first level; 0: no texture */
};

struct bump_maps_params {
    float smooth; /* share of the surface that is smooth */
    uint32_t seed;
    const float *heights;    /* of BUMP_MAPS_SIZE rows, in place of the field; NULL: it is made */
    const float *smoothness; /* likewise, 0 to 1, in place of `smooth`; NULL: it is made */
};

/* Makes the texture. Returns false when out of memory; *maps is then {0}. */
bool bump_maps_init(struct bump_maps *maps, const struct bump_maps_params *params);

void bump_maps_finish(struct bump_maps *maps);

#endif
