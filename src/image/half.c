/* half.c: IEEE 754 half-precision floats. */
#include "src/image/half.h"
/* Avoids a dependency on a lookup table in Imath's library. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>

uint16_t half_from_float(float value)
{
    const float most = 65504.0f; /* the largest finite half */
    if (value > most)
        value = most;
    else if (value < -most)
        value = -most;
    return imath_float_to_half(value);
}

float half_to_float(uint16_t bits)
{
    return imath_half_to_float(bits);
}
