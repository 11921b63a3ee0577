/* half.h: converts IEEE 754 half floats, by Imath. */
#ifndef FIRN_IMAGE_HALF_H
#define FIRN_IMAGE_HALF_H

#include <stdint.h>

/* Rounds to nearest even. Values beyond half's range become +-65504; NaN stays NaN. */
uint16_t half_from_float(float value);

float half_to_float(uint16_t bits);

#endif
