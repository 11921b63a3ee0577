/* heat_map_legend.h: colour bar of the FLIP heat map, with numbers. */
#ifndef FIRN_LAB_LADDER_HEAT_MAP_LEGEND_H
#define FIRN_LAB_LADDER_HEAT_MAP_LEGEND_H

#include "src/lab/ladder/canvas.h"

/* Draws a colour bar in `box`: left, top, width and height in pixels. The value is 1 at the top and
 * 0 at the bottom. Five numbers stand to the right of the bar, or two if the bar is short. */
void legend_draw(struct canvas *canvas, const uint32_t box[static 4], uint32_t scale);

uint32_t legend_numbers(uint32_t scale); /* width of numbers and ticks */

#endif
