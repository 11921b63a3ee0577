/* srgb.c: transfer function of sRGB. */
#include "src/file/srgb.h"
#include <math.h>

float srgb_decode(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgb_encode(float linear)
{
    const float c = fminf(fmaxf(linear, 0.0f), 1.0f);
    return c <= 0.0031308f ? c * 12.92f : 1.055f * powf(c, 1.0f / 2.4f) - 0.055f;
}
