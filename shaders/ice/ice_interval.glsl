/*
 * ice_interval.glsl: reads the depth-peeled faces of the ice along a pixel's ray, front to back.
 *
 * A peeled layer is a fitted depth whose lowest bit is 0 for an entry face and 1 for an exit face,
 * so that two faces of equal depth remain distinct, the entry first. A point is inside if more
 * entries than exits are in front of it, which also holds where parts of the ice overlap.
 */
#ifndef ICE_INTERVAL_GLSL
#define ICE_INTERVAL_GLSL
#include "ice/ice_interval.h"

#define ICE_INTERVAL_END 1.0 /* marks a layer without a face */

float ice_interval_layer(float depth, bool entering)
{
    uint bits = floatBitsToUint(depth);
    return uintBitsToFloat(entering ? bits & ~1u : bits | 1u);
}

int ice_interval_step(float layer)
{
    return (floatBitsToUint(layer) & 1u) == 0u ? 1 : -1;
}

/* Returns this pixel's depth in layer `i`. `near` holds the first peeled layers, `far` the rest. */
float ice_interval_face(sampler2DArray near, sampler2DArray far, int i)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int near_count = textureSize(near, 0).z;
    return i < near_count ? texelFetch(near, ivec3(pixel, i), 0).r
                          : texelFetch(far, ivec3(pixel, i - near_count), 0).r;
}

/* Returns true if a depth along this pixel's ray is inside the ice or on a face. */
bool ice_interval_contains(sampler2DArray near, sampler2DArray far, float depth)
{
    int count = 2 * textureSize(near, 0).z;
    int nesting = 0;
    for (int i = 0; i < count; i++) {
        float layer = ice_interval_face(near, far, i);
        int step = ice_interval_step(layer);
        if (layer == ICE_INTERVAL_END || layer > depth || (layer == depth && step < 0))
            break;
        nesting += step;
    }
    return nesting > 0;
}

int ice_interval_count(sampler2DArray near, sampler2DArray far)
{
    int count = 2 * textureSize(near, 0).z;
    int nesting = 0;
    int intervals = 0;
    for (int i = 0; i < count; i++) {
        float layer = ice_interval_face(near, far, i);
        if (layer == ICE_INTERVAL_END)
            break;
        int step = ice_interval_step(layer);
        intervals += step > 0 && nesting == 0 ? 1 : 0;
        nesting += step;
    }
    return intervals;
}
#endif
