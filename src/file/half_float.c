/* half_float.c: IEEE 754 half-precision floats. */
#include "src/file/half_float.h"
/* Macro that makes Imath work without the lookup table in its library. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>

uint16_t half_from_float(float value)
{
    const float half_max = 65504.0f; /* maximum finite half */
    if (value > half_max)
        value = half_max;
    else if (value < -half_max)
        value = -half_max;
    return imath_float_to_half(value);
}

float half_to_float(uint16_t bits)
{
    return imath_half_to_float(bits);
}
