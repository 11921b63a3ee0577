/* srgb.c: the transfer function of sRGB. */
#include "src/image/srgb.h"
#include <math.h>

float srgb_decode(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
}
