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

/* At an entering face and at a leaving one is inside. */
bool ice_interval_contains(sampler2DArray layers, float depth)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int count = textureSize(layers, 0).z;
    int within = 0;
    for (int i = 0; i < count; i++) {
        float layer = texelFetch(layers, ivec3(pixel, i), 0).r;
        int way = ice_interval_step(layer);
        if (layer == ICE_INTERVAL_END || layer > depth || (layer == depth && way < 0))
            break;
        within += way;
    }
    return within > 0;
}

int ice_interval_count(sampler2DArray layers)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    int count = textureSize(layers, 0).z;
    int within = 0;
    int intervals = 0;
    for (int i = 0; i < count; i++) {
        float layer = texelFetch(layers, ivec3(pixel, i), 0).r;
        if (layer == ICE_INTERVAL_END)
            break;
        int way = ice_interval_step(layer);
        intervals += way > 0 && within == 0 ? 1 : 0;
        within += way;
    }
    return intervals;
}
#endif
