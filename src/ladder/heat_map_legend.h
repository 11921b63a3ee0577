/* heat_map_legend.h: colour bar of the FLIP heat map, with numbers. */
#ifndef FIRN_LADDER_HEAT_MAP_LEGEND_H
#define FIRN_LADDER_HEAT_MAP_LEGEND_H

#include "src/ladder/canvas.h"

/* Draws a colour bar in `box` (left, top, width, height in pixels), with 1 at the top and 0 at the
 * bottom. Draws as many numbers beside the bar as fit, at most legend_numbers() pixels wide. */
void legend_draw(struct canvas *canvas, const uint32_t box[static 4], uint32_t scale);

uint32_t legend_numbers(uint32_t scale); /* width of numbers and ticks */

#endif
