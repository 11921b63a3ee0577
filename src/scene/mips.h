/*
 * mips.h: smaller and smaller copies of square pictures, made with them.
 *
 * A device could halve them too, but would have to compile shaders for that before it draws its
 * first picture, and each would round in its own way.
 *
 * Level after level, from `side` texels to one, each with its layers one after another.
 */
#ifndef FIRN_SCENE_MIPS_H
#define FIRN_SCENE_MIPS_H

#include <stddef.h>
#include <stdint.h>

struct mips {
    uint32_t side;     /* texels, both ways, of the first level: a power of two */
    uint32_t layers;   /* of every level */
    uint32_t channels; /* of a texel */
};

/* Numbers in all levels together. */
size_t mips_count(const struct mips *mips);

/* Fill all levels from the first: means of four, of halves rounded to zero, of bytes away from
 * it, first along rows. */
void mips_fill_halves(uint16_t *texels, const struct mips *mips);
void mips_fill_bytes(uint8_t *texels, const struct mips *mips);

#endif
