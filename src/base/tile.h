/*
 * tile.h: which pixels of a picture belong to a tile.
 *
 * The tiles of a picture form columns and rows, numbered row by row from 0. They begin at even
 * pixels, so that none divides the 2x2 pixels from which a device computes derivatives; apart from
 * that their sizes are as equal as possible.
 */
#ifndef FIRN_BASE_TILE_H
#define FIRN_BASE_TILE_H

#include <stdbool.h>
#include <stdint.h>

struct tile {
    uint32_t x, y, width, height; /* pixels of the picture */
};

struct tiling {
    uint32_t width, height; /* pixels of the picture */
    uint32_t columns, rows; /* of tiles */
};

/* Returns whether each of the tiles has at least one pixel. */
bool tile_fits(const struct tiling *tiling);

/* Returns the pixels of tile `index`, below columns * rows. The tiling must fit. */
struct tile tile_at(const struct tiling *tiling, uint32_t index);

/* Returns a tile at (0, 0), as wide as the widest tile and as high as the highest one. */
struct tile tile_largest(const struct tiling *tiling);

#endif
