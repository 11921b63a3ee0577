/* ice_depth.frag: fragment shader that writes the ice's front depth, back depth and thickness. */
#version 460
#include "ice/ice_depth.h"
#include "lib/linearize_depth.glsl"
#include "lib/primary_ray.glsl"

layout(set = 0, binding = ICE_DEPTH_FRONT) uniform sampler2D front;
layout(set = 0, binding = ICE_DEPTH_BACK) uniform sampler2D back;

layout(location = 0) out float thickness; /* metres */
layout(location = 1) out float layer_front;
layout(location = 2) out float layer_back;

/* Returns the ratio of distance along this pixel's primary ray to view-space depth. */
float slant()
{
    return primary_ray_slant(
        primary_ray(gl_FragCoord.xy / vec2(textureSize(front, 0)) * 2.0 - 1.0));
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth_front = texelFetch(front, pixel, 0).r;
    float depth_back = texelFetch(back, pixel, 0).r;
    if (depth_back == 0.0)
        discard;
    layer_front = depth_front == 1.0 ? 0.0 : fitted_view_depth(depth_front);
    layer_back = fitted_view_depth(depth_back);
    thickness = max(layer_back - layer_front, 0.0) * slant();
}
