/*
 * refract_seen.glsl: reads the ice's front faces from ice_normal.front, for a triangle that covers
 * the picture. A rasteriser that shades whole blocks of pixels then shades each block once, instead
 * of once for each of the ice's triangles in it.
 */
#ifndef REFRACT_SEEN_GLSL
#define REFRACT_SEEN_GLSL
#include "lib/constants.glsl"
#include "lib/view_ray.glsl"
#include "refract.h"

layout(set = 0, binding = REFRACT_SHADING) uniform sampler2D shading;
layout(set = 0, binding = REFRACT_DEPTH_FRONT) uniform sampler2D depth_front;
#ifdef REFRACT_LAYERS
layout(set = 0, binding = REFRACT_DEPTH_SCENE) uniform sampler2D depth_scene;
#endif

layout(location = REFRACT_VIEW_RAY) in vec3 ray;

vec3 eye_to_point;
vec3 normal; /* unit; with bumps */
float fresnel_paper;

vec3 refract_front_normal()
{
    return normal;
}

/* Reads the face of this pixel. For the picture, the depth test rejects pixels without ice, and
 * this function those in which only other objects are; for layers it discards both, and pixels in
 * which surroundings hide the ice. */
void refract_front_find()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_front, pixel, 0).r;
    vec4 texel = texelFetch(shading, pixel, 0);
    eye_to_point = view_at(ray, view_distance(refract_frame.clip_from_world, depth));
    normal = texel.xyz;
    fresnel_paper = texel.w;
#ifdef REFRACT_LAYERS
    if (depth == 0.0 || depth < texelFetch(depth_scene, pixel, 0).r)
        discard;
#else
    if (constant_objects == 1u && depth == 0.0)
        discard;
#endif
}

#endif
