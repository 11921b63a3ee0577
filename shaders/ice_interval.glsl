/*
 * ice_interval.glsl: the faces of the ice that a pixel's ray meets, in their order.
 *
 * A layer is a fitted depth whose lowest bit says which way the face is crossed: 0 in, 1 out. So
 * faces at one depth are still two, in before out, and no parity is needed: a point is inside if
 * more faces were entered than left on the way to it, also where parts of the ice overlap.
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

/* The pixel's face i, of the nearer half of the layers or of the others. */
float ice_interval_face(sampler2DArray near, sampler2DArray far, int i)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int near_count = textureSize(near, 0).z;
    return i < near_count ? texelFetch(near, ivec3(pixel, i), 0).r
                          : texelFetch(far, ivec3(pixel, i - near_count), 0).r;
}

/* At an entering face and at a leaving one is inside. */
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
