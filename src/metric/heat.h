/* heat.h: a colour map of errors from 0 to 1: black, violet, red, pale yellow. */
#ifndef FIRN_METRIC_HEAT_H
#define FIRN_METRIC_HEAT_H

#include <stdint.h>

/*
 * Returns an sRGB-encoded colour. CIE L* rises linearly from 2 to 97, so that the map is readable
 * without colour, and the hue turns from blue over red to yellow. Errors are clamped to 0 and 1.
 */
void heat_srgb(float error, uint8_t rgb[static 3]);

#endif
