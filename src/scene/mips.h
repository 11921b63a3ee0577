/*
 * mips.h: mip levels of square images, generated on the host.
 *
 * A device could generate them too, but would have to compile shaders for that before it draws its
 * first picture, and devices round differently.
 *
 * Memory has level after level, from `side` texels to one, each with its layers one after another.
 */
#ifndef FIRN_SCENE_MIPS_H
#define FIRN_SCENE_MIPS_H

#include <stddef.h>
#include <stdint.h>

struct mips {
    uint32_t side;     /* texels along each side of the first level: a power of two */
    uint32_t layers;   /* of every level */
    uint32_t channels; /* per texel */
};

/* Returns the number of values in all levels together. */
size_t mips_count(const struct mips *mips);

/* Fill all other levels from the first one with means of four texels, which are added up along rows
 * first. Halves are rounded toward zero, bytes away from it. */
void mips_fill_halves(uint16_t *texels, const struct mips *mips);
void mips_fill_bytes(uint8_t *texels, const struct mips *mips);

#endif
