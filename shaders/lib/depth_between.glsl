/*
 * depth_between.glsl: lookups in maps of depths, 0 where there is no face.
 *
 * The latency of this function limits marches. Therefore it has no min(), which tests for NaN on
 * CPUs, and as few dependent additions as possible.
 */
#ifndef DEPTH_BETWEEN_GLSL
#define DEPTH_BETWEEN_GLSL

/* Returns the depth among four texels, in the order of textureGather(), of which a point is `share`
 * to the right of and below the first: bilinear if all of them show a face, else that of the
 * nearest one. */
float depth_between(vec4 d, vec2 share)
{
    float low = fma(share.x, d.z - d.w, d.w);
    float high = fma(share.x, d.y - d.x, d.x);
    float linear = fma(share.y, high - low, low);
    vec2 near = share.x < 0.5 ? d.wx : d.zy;
    float nearest = share.y < 0.5 ? near.x : near.y;
    return all(greaterThan(d, vec4(0.0))) ? linear : nearest;
}

#endif
