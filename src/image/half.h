/* half.h: IEEE 754 half floats, by Imath. */
#ifndef FIRN_IMAGE_HALF_H
#define FIRN_IMAGE_HALF_H

#include <stdint.h>

/* Round to nearest even; beyond half's range, +-65504; NaN stays NaN. */
uint16_t half_from_float(float value);

float half_to_float(uint16_t bits);

#endif
