/*
 * depth_map_bilinear.glsl: interpolation of depth maps in which 0 means no face.
 *
 * The latency of this function limits ray marching. The function therefore has few dependent
 * additions. It avoids min(), because min() tests for NaN on CPUs.
 */
#ifndef DEPTH_MAP_BILINEAR_GLSL
#define DEPTH_MAP_BILINEAR_GLSL

/* Interpolates four depths, in textureGather() order, at `fraction` from 0 to 1. If any of the four
 * texels has no face, returns the nearest texel's depth instead. */
float depth_interpolate(vec4 d, vec2 fraction)
{
    float low = fma(fraction.x, d.z - d.w, d.w);
    float high = fma(fraction.x, d.y - d.x, d.x);
    float linear = fma(fraction.y, high - low, low);
    vec2 near = fraction.x < 0.5 ? d.wx : d.zy;
    float nearest = fraction.y < 0.5 ? near.x : near.y;
    return all(greaterThan(d, vec4(0.0))) ? linear : nearest;
}

#endif
