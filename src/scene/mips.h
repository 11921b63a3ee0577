/*
 * mips.h: mip levels of square images, generated on the CPU.
 *
 * The CPU avoids shader compilation before the first frame, and rounds equally everywhere.
 *
 * Memory layout: levels from `side` texels down to one, each with all array layers.
 */
#ifndef FIRN_SCENE_MIPS_H
#define FIRN_SCENE_MIPS_H

#include <stddef.h>
#include <stdint.h>

struct mips {
    uint32_t side;     /* width and height of the first level, texels; a power of two */
    uint32_t layers;   /* array layers */
    uint32_t channels; /* channels per texel */
};

/* Returns the number of values in all levels. */
size_t mips_count(const struct mips *mips);

/* Fill all levels after the first by box filtering, horizontally first. Half floats are rounded
 * towards zero, bytes away from it. */
void mips_fill_halves(uint16_t *texels, const struct mips *mips);
void mips_fill_bytes(uint8_t *texels, const struct mips *mips);

#endif
