/* heat_map.h: heat map of errors from 0 to 1: black, violet, red, pale yellow. */
#ifndef FIRN_LAB_METRIC_HEAT_MAP_H
#define FIRN_LAB_METRIC_HEAT_MAP_H

#include <stdint.h>

/*
 * Converts an error, clamped to 0..1, to an sRGB-encoded colour. The hue goes from blue via red to
 * yellow. Lightness (CIE L*) rises linearly from 2 to 97, which suits greyscale prints.
 */
void heat_map_srgb(float error, uint8_t rgb[static 3]);

#endif
