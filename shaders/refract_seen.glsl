/*
 * refract_seen.glsl: the ice's front faces as ice_normal.front shows them, for a triangle that
 * covers the picture: a rasteriser that shades whole blocks of pixels does so once for each block,
 * and not once for each triangle of the ice in it.
 */
#ifndef REFRACT_SEEN_GLSL
#define REFRACT_SEEN_GLSL
#include "lib/view_ray.glsl"
#include "refract.h"

layout(set = 0, binding = REFRACT_SHADING) uniform sampler2D shading;
layout(set = 0, binding = REFRACT_DEPTH_FRONT) uniform sampler2D depth_front;
#ifdef REFRACT_LAYERS
layout(set = 0, binding = REFRACT_DEPTH_SCENE) uniform sampler2D depth_scene;
#endif

layout(location = REFRACT_VIEW_RAY) in vec3 ray;

vec3 eye_to_point;
vec3 normal; /* unit; as bumps bend it */
float fresnel_paper;

vec3 refract_front_normal()
{
    return normal;
}

/* The depth test leaves out what is no ice; of layers, the shader, and what surroundings hide. */
void refract_front_find()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_front, pixel, 0).r;
    vec4 texel = texelFetch(shading, pixel, 0);
    eye_to_point = view_distance(refract_frame.clip_from_world, depth) * ray;
    normal = texel.xyz;
    fresnel_paper = texel.w;
#ifdef REFRACT_LAYERS
    if (depth == 0.0 || depth < texelFetch(depth_scene, pixel, 0).r)
        discard;
#endif
}

#endif
