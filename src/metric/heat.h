/* heat.h: errors from 0 to 1 as colours, from black over violet and red to a pale yellow. */
#ifndef FIRN_METRIC_HEAT_H
#define FIRN_METRIC_HEAT_H

#include <stdint.h>

/*
 * sRGB. L* of CIE rises from 2 to 97 in equal steps, so that a picture of errors reads the same in
 * grey, and the hue turns from blue to yellow on the way of red. Beyond 0 and 1 lie their colours.
 */
void heat_srgb(float error, uint8_t rgb[static 3]);

#endif
