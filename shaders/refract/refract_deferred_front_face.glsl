/* refract_deferred_front_face.glsl: reads the visible front face from the G-buffer
 * ice_normal.front. The ice is shaded by a full-screen triangle instead of by its own triangles.
 * Rasterisers that shade blocks of pixels then shade each block once, not once per triangle of the
 * ice. */
#ifndef REFRACT_FULLSCREEN_GLSL
#define REFRACT_FULLSCREEN_GLSL
#include "lib/primary_ray.glsl"
#include "lib/specialization_constants.glsl"
#include "refract/refract.h"

layout(set = 0, binding = REFRACT_SHADING) uniform sampler2D shading;
layout(set = 0, binding = REFRACT_DEPTH_FRONT) uniform sampler2D depth_front;

layout(location = REFRACT_VIEW_RAY) in vec3 ray;

vec3 eye_to_point;
float front_depth; /* depth-buffer value; 0 without ice */
vec3 normal;       /* unit length, bump mapped */
float fresnel_paper;

vec3 refract_front_normal()
{
    return normal;
}

/* Reads the pixel's front face. Discards pixels without ice. */
void refract_front_read()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    front_depth = texelFetch(depth_front, pixel, 0).r;
    vec4 texel = texelFetch(shading, pixel, 0);
    eye_to_point = primary_ray_at(ray, view_depth(refract_frame.clip_from_world, front_depth));
    normal = texel.xyz;
    fresnel_paper = texel.w;
    if (constant_objects == 1u && front_depth == 0.0)
        discard;
}

#endif
