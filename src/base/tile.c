/* tile.c: divides an image into tiles of nearly equal size. */
#include "src/base/tile.h"

bool tile_fits(const struct tiling *tiling)
{
    return (tiling->columns <= 1 || tiling->width / 2 >= tiling->columns) &&
           (tiling->rows <= 1 || tiling->height / 2 >= tiling->rows);
}

/* Returns the first pixel of tile column (or row) `index`. Returns `side` if `index` is `count`. */
static uint32_t tile_begin(uint32_t side, uint32_t count, uint32_t index)
{
    const uint64_t at = (uint64_t)side * index / count;
    return index == count ? side : (uint32_t)at & ~UINT32_C(1);
}

struct tile tile_at(const struct tiling *tiling, uint32_t index)
{
    const uint32_t column = index % tiling->columns, row = index / tiling->columns;
    const uint32_t x = tile_begin(tiling->width, tiling->columns, column);
    const uint32_t y = tile_begin(tiling->height, tiling->rows, row);
    return (struct tile){
        .x = x,
        .y = y,
        .width = tile_begin(tiling->width, tiling->columns, column + 1) - x,
        .height = tile_begin(tiling->height, tiling->rows, row + 1) - y,
    };
}

struct tile tile_largest(const struct tiling *tiling)
{
    struct tile largest = { 0 };
    for (uint32_t i = 0; i < tiling->columns * tiling->rows; i++) {
        const struct tile tile = tile_at(tiling, i);
        if (tile.width > largest.width)
            largest.width = tile.width;
        if (tile.height > largest.height)
            largest.height = tile.height;
    }
    return largest;
}
