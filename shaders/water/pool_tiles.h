/* pool_tiles.h: procedural pool tiles: squares in several shades of blue, with light joints. */
#ifndef SHADERS_WATER_POOL_TILES_H
#define SHADERS_WATER_POOL_TILES_H
#include "abi_math.h"

#define TILES_JOINT 0.06f /* width of the joints, in tiles */

/* Integrates, from 0 to x, a function that is 1 in the first `fraction` of each unit, else 0. */
ABI_FUNCTION float tiles_stripes(float x, float fraction)
{
    return floorf(x) * fraction + fminf(x - floorf(x), fraction);
}

/* Returns the coverage of stripes in a pixel of a given width (analytic box filter). */
ABI_FUNCTION float tiles_stripes_within(float x, float width, float fraction)
{
    return (tiles_stripes(x + 0.5f * width, fraction) - tiles_stripes(x - 0.5f * width, fraction)) /
           width;
}

/* Returns a random number from 0 to 1 for the tile at a point. */
ABI_FUNCTION float tiles_shade(vec2s at)
{
    uint32_t h = (ABI_UINT(ABI_INT(floorf(at.x))) * 0x9e3779b9u) ^
                 (ABI_UINT(ABI_INT(floorf(at.y))) * 0x85ebca6bu);
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    return ABI_FLOAT(h >> 8) / 16777216.0f;
}

/* Returns the colour at a point in units of tiles, box-filtered over a pixel `width` tiles wide. */
ABI_FUNCTION vec3s tiles_color(vec2s at, vec2s width)
{
    float shown = glm_clamp(1.5f - fmaxf(width.x, width.y), 0.0f, 1.0f);
    float shade = glm_lerp(0.5f, tiles_shade(at), shown);
    vec3s tile =
        glms_vec3_lerp(ABI_VEC3(0.20f, 0.46f, 0.56f), ABI_VEC3(0.34f, 0.62f, 0.68f), shade);
    float joints = 1.0f - (1.0f - tiles_stripes_within(at.x, width.x, TILES_JOINT)) *
                              (1.0f - tiles_stripes_within(at.y, width.y, TILES_JOINT));
    return glms_vec3_lerp(tile, ABI_VEC3(0.80f, 0.82f, 0.80f), joints);
}

#endif
