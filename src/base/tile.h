/*
 * tile.h: which part of a picture a tile is.
 *
 * Tiles of a picture lie in columns and rows, numbered row by row from 0. They begin at even
 * pixels, so that none parts the 2x2 pixels of which a device takes derivatives, and are as equal
 * as that allows.
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

/* Whether each of the tiles has pixels. */
bool tile_fits(const struct tiling *tiling);

/* Of tiles that fit. */
struct tile tile_at(const struct tiling *tiling, uint32_t index);

/* At (0, 0), as wide as the widest and as high as the highest of them. */
struct tile tile_largest(const struct tiling *tiling);

#endif
