#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice_depth.h"
#include "lib/fitted.glsl"

layout(set = 0, binding = ICE_DEPTH_FRONT) uniform sampler2D front;
layout(set = 0, binding = ICE_DEPTH_BACK) uniform sampler2D back;

layout(location = 0) out vec4 layers; /* metres: front, back, thickness */

/* Metres along this pixel's ray for each metre along the view's axis. */
float slant()
{
    vec2 ndc = gl_FragCoord.xy / vec2(textureSize(front, 0)) * 2.0 - 1.0;
    mat4 m = frame.clip_from_world;
    /* the rows of a projection are the picture's axes, divided by its half sizes */
    vec3 x = vec3(m[0][0], m[1][0], m[2][0]);
    vec3 y = vec3(m[0][1], m[1][1], m[2][1]);
    vec3 w = vec3(m[0][3], m[1][3], m[2][3]);
    vec3 ray = inverse(transpose(mat3(x, y, w))) * vec3(ndc, 1.0);
    return length(ray) / dot(ray, w);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth_front = texelFetch(front, pixel, 0).r;
    float depth_back = texelFetch(back, pixel, 0).r;
    layers = vec4(0.0);
    if (depth_back == 0.0)
        return;
    layers.x = depth_front == 1.0 ? 0.0 : fitted_distance(depth_front);
    layers.y = fitted_distance(depth_back);
    layers.z = max(layers.y - layers.x, 0.0) * slant();
}
