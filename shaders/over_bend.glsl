/*
 * over_bend.glsl: bubbles along refracted rays: searches the bubbles' depth image for the hit of a
 * pixel's refracted ray; part of over.frag with BUBBLES_BENT.
 *
 * Error: the shading of the bubbles is that of straight primary rays.
 */
#ifndef OVER_BEND_GLSL
#define OVER_BEND_GLSL
#include "lib/optics.glsl"
#include "lib/view_ray.glsl"
#include "within.glsl"

#ifdef OVER_VERTEX
#define OVER_BEND_IO out
#else
#define OVER_BEND_IO in
#endif

layout(location = OVER_BEND) OVER_BEND_IO vec3 bend_ray;

/* Uniforms of `frame`, passed as flat varyings like in refract_frame.glsl. */
layout(location = OVER_BEND + 1) OVER_BEND_IO OverBend
{
    flat mat4 clip_from_world;
    flat vec4 eye;    /* w: index of refraction outside relative to inside */
    flat vec4 center; /* w: radius */
    flat vec3 forward;
}

bend;

#ifdef OVER_VERTEX
void bend_hand_on(vec2 corner)
{
    bend_ray = view_ray(corner);
    bend.clip_from_world = frame.clip_from_world;
    bend.eye = vec4(frame.eye, frame.eta);
    bend.center = vec4(frame.center, frame.radius);
    bend.forward = frame.forward;
}
#else
layout(set = 0, binding = OVER_FRONT_DEPTH) uniform sampler2D front_depth;
layout(set = 0, binding = OVER_SHADING) uniform sampler2D shading;
layout(set = 0, binding = OVER_BUBBLE_DEPTH) uniform sampler2D bubble_depth;

/* Projects a homogeneous point or direction to texel coordinates of the bubbles' images. */
vec4 bend_texels(vec4 v)
{
    vec2 size = vec2(textureSize(bubble_depth, 0));
    vec4 at = bend.clip_from_world * v;
    return vec4(0.5 * size * at.xy + (0.5 * size - 0.5) * at.w, at.zw);
}

vec4 bend_bubbles(sampler2D bubbles)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(front_depth, pixel, 0).r;
    vec3 eye_to_point = view_at(bend_ray, view_distance(bend.clip_from_world, depth));
    vec3 point = bend.eye.xyz + eye_to_point;
    vec3 dir =
        optics_refract(view_dir(eye_to_point), texelFetch(shading, pixel, 0).xyz, bend.eye.w);
    vec3 from_center = point - bend.center.xyz;
    float radius = bend.center.w;
    within_ray ray;
    ray.from = bend_texels(vec4(point, 1.0));
    ray.way = bend_texels(vec4(dir, 0.0));
    ray.depth = within_depth(from_center, bend.forward, radius);
    ray.pace = max(0.5 * dot(dir, bend.forward) / radius, 1e-3);
    ray.is_across = false;
    float middle = dot(from_center, dir);
    float outside = dot(from_center, from_center) - radius * radius;
    float max_length = sqrt(max(middle * middle - outside, 0.0)) - middle;
    float t = within_find(bubble_depth, ray, max_length);
    vec4 found = texelFetch(bubbles, within_texel(ray, min(t, max_length)), 0);
    return t < within_none ? found : vec4(0.0);
}
#endif
#endif
