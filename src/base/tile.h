/*
 * tile.h: divides an image into columns and rows of tiles, numbered row by row from 0. Tiles begin
 * at even pixels, because tile boundaries must not cut the 2x2 pixel quads of derivatives. Apart
 * from this, tile sizes are as equal as possible.
 */
#ifndef FIRN_BASE_TILE_H
#define FIRN_BASE_TILE_H

#include <stdbool.h>
#include <stdint.h>

struct tile {
    uint32_t x, y, width, height; /* pixels of the image */
};

struct tiling {
    uint32_t width, height; /* pixels of the image */
    uint32_t columns, rows; /* number of tiles across and down */
};

/* Returns true if every tile has at least one pixel. */
bool tile_fits(const struct tiling *tiling);

/* Returns the rectangle of tile `index` (below columns * rows). tile_fits() must be true. */
struct tile tile_at(const struct tiling *tiling, uint32_t index);

/* Returns a tile at (0, 0) with the maximum width and maximum height of all tiles. */
struct tile tile_largest(const struct tiling *tiling);

#endif
