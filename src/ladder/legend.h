/* legend.h: colour bar of the heat map in heat_map.h, with numbers. */
#ifndef FIRN_LADDER_LEGEND_H
#define FIRN_LADDER_LEGEND_H

#include "src/ladder/canvas.h"

/* Draws a vertical colour bar from 1 at the top to 0 in `box`: left, top, width, height in pixels.
 * As many numbers as fit are written beside it, at most legend_numbers() pixels wide. */
void legend_put(struct canvas *canvas, const uint32_t box[static 4], uint32_t scale);

uint32_t legend_numbers(uint32_t scale); /* including the length of a tick */

#endif
