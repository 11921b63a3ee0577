/* legend.h: the scale of heat.h's colours, with numbers. */
#ifndef FIRN_LADDER_LEGEND_H
#define FIRN_LADDER_LEGEND_H

#include "src/ladder/canvas.h"

/* Draws a bar whose `box` is left, top, width, height in pixels, from 1 at the top to 0, and beside
 * it numbers, as many as there is room for, of at most legend_numbers() pixels in width. */
void legend_put(struct canvas *canvas, const uint32_t box[static 4], uint32_t scale);

uint32_t legend_numbers(uint32_t scale); /* the tick's length included */

#endif
