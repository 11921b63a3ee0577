/*
 * bump_maps.h: the uneven surface of ice as a picture that repeats, made by code.
 *
 * A height of dimples, as melting leaves them, under ever finer noise: its slopes. Noise again says
 * where the surface is smooth all the same. The same numbers give the same bytes on every machine.
 *
 * Ownership: bump_maps_finish() frees them; {0} is fine.
 */
#ifndef FIRN_SCENE_BUMP_MAPS_H
#define FIRN_SCENE_BUMP_MAPS_H

#include <stdbool.h>
#include <stdint.h>

enum {
    BUMP_MAPS_SIZE = 512, /* texels, both ways */
};

struct bump_maps {
    uint16_t *texels; /* half, four each: rise along u and v, 1 in the root mean square; how smooth
                         the surface is and how thick its crystals stand, 0 to 1; all levels of
                         mips.h */
    uint32_t size;    /* texels, both ways; 0: none */
};

struct bump_maps_params {
    float smooth; /* share of the surface that is smooth */
    uint32_t seed;
};

/* False only when memory is short; *maps is then {0}. */
bool bump_maps_init(struct bump_maps *maps, const struct bump_maps_params *params);

void bump_maps_finish(struct bump_maps *maps);

#endif
