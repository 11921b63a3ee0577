/* mip_levels.h: generates mip levels of square images on the CPU. All machines thus round alike,
 * and the first frame needs no shader for it. Levels are stored from `side` texels down to one.
 * Each level contains all array layers. */
#ifndef FIRN_SCENE_MIP_LEVELS_H
#define FIRN_SCENE_MIP_LEVELS_H

#include <stddef.h>
#include <stdint.h>

struct mip_levels {
    uint32_t side; /* width and height of the finest level, a power of two */
    uint32_t layers;
    uint32_t channels;
};

/* Returns the number of values in all levels. */
size_t mip_levels_count(const struct mip_levels *mip_levels);

/* Fill all levels after the first by box filtering, first horizontally, then vertically. Half
 * floats are rounded towards zero. Bytes are rounded away from zero. */
void mip_levels_fill_halves(uint16_t *texels, const struct mip_levels *mip_levels);
void mip_levels_fill_bytes(uint8_t *texels, const struct mip_levels *mip_levels);

#endif
