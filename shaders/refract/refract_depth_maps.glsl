/*
 * refract_depth_maps.glsl: lookups in the screen-space depth and normal maps of the ice.
 *
 * Depth is the near plane's distance over the view-space distance, or 0 without a face. On a plane,
 * depth is linear in screen space. Along a ray, clip coordinates are linear.
 */
#ifndef REFRACT_DEPTH_MAPS_GLSL
#define REFRACT_DEPTH_MAPS_GLSL
#include "lib/depth_map_bilinear.glsl"
#include "refract/refract_uniforms.glsl"

layout(set = 0, binding = REFRACT_DEPTH_BACK) uniform sampler2D depth_back;
layout(set = 0, binding = REFRACT_NORMAL_BACK) uniform sampler2D normal_back;

vec4 refract_clip(vec3 point)
{
    return refract_frame.clip_from_world * vec4(point, 1.0);
}

vec2 refract_uv(vec4 clip)
{
    return clip.xy / clip.w * 0.5 + 0.5;
}

/* Returns the texel at a point in clip coordinates, clamped to the image. */
ivec2 refract_texel(vec4 clip)
{
    ivec2 size = textureSize(depth_back, 0);
    return clamp(ivec2(refract_uv(clip) * vec2(size)), ivec2(0), size - 1);
}

/* Returns the interpolated depth at a position in texels from the first texel's centre. */
float refract_depth_at(sampler2D depths, vec2 at, vec2 texel)
{
    vec2 corner = floor(at);
    vec2 fraction = at - corner;
    return depth_interpolate(textureGather(depths, fma(corner, texel, texel)), fraction);
}

float refract_depth_at_uv(sampler2D depths, vec2 uv)
{
    vec2 size = vec2(textureSize(depths, 0));
    return refract_depth_at(depths, uv * size - 0.5, 1.0 / size);
}

/* Returns the mean normal of the nearest texels that have a face, or 0 if none has one. */
vec3 refract_normal_at(sampler2D normals, vec2 uv)
{
    vec3 n = texture(normals, uv).xyz;
    float length2 = dot(n, n);
    return length2 > 0.0 ? n * inversesqrt(length2) : vec3(0.0);
}

#endif
