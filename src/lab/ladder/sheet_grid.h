/* sheet_grid.h: grid layout of `firn sheet`, used to write and to cut contact sheets. */
#ifndef FIRN_LAB_LADDER_SHEET_GRID_H
#define FIRN_LAB_LADDER_SHEET_GRID_H

#include <stdint.h>
#include "src/lab/ladder/canvas.h"

enum {
    SHEET_COLUMNS = 4,       /* images per row */
    SHEET_MARGIN = 8,        /* margin around each image, pixels */
    SHEET_LABEL_WIDTH = 150, /* label width at scale 1, pixels */
};

/* Metadata of a sheet: the labels of its images in order, separated by commas. */
#define SHEET_LABELS "firn/labels"

/* Grid of images of equal size, each below a line of text. All lengths are in pixels. */
struct sheet_grid {
    uint32_t columns;       /* images per row */
    uint32_t width, height; /* of an image */
};

static inline uint32_t sheet_text_scale(const struct sheet_grid *grid)
{
    return grid->width >= 2 * SHEET_LABEL_WIDTH ? 2 : 1;
}

static inline uint32_t sheet_label_height(const struct sheet_grid *grid)
{
    return sheet_text_scale(grid) * CANVAS_TEXT_HEIGHT + 4;
}

/* Returns the width of a sheet, in pixels. */
static inline uint32_t sheet_width(const struct sheet_grid *grid)
{
    return grid->columns * (grid->width + SHEET_MARGIN) + SHEET_MARGIN;
}

static inline uint32_t sheet_height(const struct sheet_grid *grid, uint32_t count)
{
    const uint32_t rows = (count + grid->columns - 1) / grid->columns;
    return rows * (grid->height + sheet_label_height(grid) + SHEET_MARGIN) + SHEET_MARGIN;
}

/* Returns the left edge of image i, in pixels. */
static inline uint32_t sheet_left(const struct sheet_grid *grid, uint32_t i)
{
    return SHEET_MARGIN + i % grid->columns * (grid->width + SHEET_MARGIN);
}

/* Returns the top edge of image i's label, in pixels. */
static inline uint32_t sheet_top(const struct sheet_grid *grid, uint32_t i)
{
    const uint32_t row = grid->height + sheet_label_height(grid) + SHEET_MARGIN;
    return SHEET_MARGIN + i / grid->columns * row;
}

#endif
