/* sheet_grid.h: where the pictures of a `firn sheet` are, for who writes one and who cuts it. */
#ifndef FIRN_LADDER_SHEET_GRID_H
#define FIRN_LADDER_SHEET_GRID_H

#include <stdint.h>
#include "src/ladder/canvas.h"

enum {
    SHEET_COLUMNS = 4, /* of values of one parameter */
    SHEET_MARGIN = 8,  /* around each picture, pixels */
    SHEET_ROOM = 150,  /* for words of scale 1, pixels */
};

/* Pictures of one size in rows, each below a line of words. Lengths are pixels. */
struct sheet_grid {
    uint32_t columns;       /* pictures in a row */
    uint32_t width, height; /* of a picture */
};

static inline uint32_t sheet_letter_scale(const struct sheet_grid *grid)
{
    return grid->width >= 2 * SHEET_ROOM ? 2 : 1;
}

static inline uint32_t sheet_label_height(const struct sheet_grid *grid)
{
    return sheet_letter_scale(grid) * CANVAS_TEXT_HEIGHT + 4;
}

/* The size of a sheet of so many pictures. */
static inline uint32_t sheet_width(const struct sheet_grid *grid)
{
    return grid->columns * (grid->width + SHEET_MARGIN) + SHEET_MARGIN;
}

static inline uint32_t sheet_height(const struct sheet_grid *grid, uint32_t count)
{
    const uint32_t rows = (count + grid->columns - 1) / grid->columns;
    return rows * (grid->height + sheet_label_height(grid) + SHEET_MARGIN) + SHEET_MARGIN;
}

/* The left edge of picture i, and the upper edge of its words; it is below them. */
static inline uint32_t sheet_left(const struct sheet_grid *grid, uint32_t i)
{
    return SHEET_MARGIN + i % grid->columns * (grid->width + SHEET_MARGIN);
}

static inline uint32_t sheet_top(const struct sheet_grid *grid, uint32_t i)
{
    const uint32_t row = grid->height + sheet_label_height(grid) + SHEET_MARGIN;
    return SHEET_MARGIN + i / grid->columns * row;
}

#endif
