/* heat_map.c: heat map colours of error images. */
#include "src/lab/metric/heat_map.h"
#include <math.h>

/* sRGB colours of the heat map at equally spaced t from 0 to 1. In CIE L*C*h (D65), lightness L* is
 * 2 + 95 t and hue h is 290 + 170 t degrees. Chroma C* is 0.88 times the maximum in the sRGB gamut,
 * but at most 75. */
static const uint8_t heat_map[17][3] = {
    { 2, 4, 35 },      { 9, 15, 72 },     { 48, 8, 99 },     { 82, 14, 97 },    { 109, 20, 99 },
    { 137, 26, 100 },  { 164, 32, 100 },  { 192, 38, 98 },   { 221, 45, 91 },   { 243, 65, 81 },
    { 245, 103, 83 },  { 246, 133, 89 },  { 248, 159, 101 }, { 250, 183, 117 }, { 251, 205, 139 },
    { 253, 227, 168 }, { 254, 247, 213 },
};

void heat_map_srgb(float error, uint8_t rgb[static 3])
{
    const float at = 16.0f * fminf(fmaxf(error, 0.0f), 1.0f);
    const int i = at < 16.0f ? (int)at : 15;
    for (int c = 0; c < 3; c++) {
        const float low = heat_map[i][c], high = heat_map[i + 1][c];
        rgb[c] = (uint8_t)(low + (high - low) * (at - (float)i) + 0.5f);
    }
}
