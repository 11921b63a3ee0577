/*
 * ice_interval.glsl: the faces of the ice along a pixel's ray, in their order.
 *
 * A layer is a fitted depth whose lowest bit is 0 where the ray enters through the face and 1 where
 * it leaves. So two faces at one depth remain distinct, the entering one first. A point is inside
 * if more faces were entered than left before it, which also holds where parts of the ice overlap.
 */
#ifndef ICE_INTERVAL_GLSL
#define ICE_INTERVAL_GLSL
#include "ice_interval.h"

#define ICE_INTERVAL_END 1.0 /* no more faces */

float ice_interval_layer(float depth, bool entering)
{
    uint bits = floatBitsToUint(depth);
    return uintBitsToFloat(entering ? bits & ~1u : bits | 1u);
}

int ice_interval_step(float layer)
{
    return (floatBitsToUint(layer) & 1u) == 0u ? 1 : -1;
}

/* Returns the pixel's face i, from the nearer or the farther half of the layers. */
float ice_interval_face(sampler2DArray near, sampler2DArray far, int i)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int near_count = textureSize(near, 0).z;
    return i < near_count ? texelFetch(near, ivec3(pixel, i), 0).r
                          : texelFetch(far, ivec3(pixel, i - near_count), 0).r;
}

/* Returns whether a depth is inside; the depths of the faces themselves are inside. */
bool ice_interval_contains(sampler2DArray near, sampler2DArray far, float depth)
{
    int count = 2 * textureSize(near, 0).z;
    int within = 0;
    for (int i = 0; i < count; i++) {
        float layer = ice_interval_face(near, far, i);
        int way = ice_interval_step(layer);
        if (layer == ICE_INTERVAL_END || layer > depth || (layer == depth && way < 0))
            break;
        within += way;
    }
    return within > 0;
}

int ice_interval_count(sampler2DArray near, sampler2DArray far)
{
    int count = 2 * textureSize(near, 0).z;
    int within = 0;
    int intervals = 0;
    for (int i = 0; i < count; i++) {
        float layer = ice_interval_face(near, far, i);
        if (layer == ICE_INTERVAL_END)
            break;
        int way = ice_interval_step(layer);
        intervals += way > 0 && within == 0 ? 1 : 0;
        within += way;
    }
    return intervals;
}
#endif
