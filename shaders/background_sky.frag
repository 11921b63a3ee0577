#version 460
#extension GL_GOOGLE_include_directive : require
#include "background.h"
#include "lib/globals.glsl"
#include "lib/sky.glsl"

layout(push_constant, scalar) uniform Push
{
    background_push push;
};

layout(set = 0, binding = BACKGROUND_ENVIRONMENT) uniform sampler2D environment;

layout(location = 0) in vec3 dir;
layout(location = 0) out vec4 color;

/* Longitude and latitude of a unit direction: -Z in the middle of the picture, +Y at its top. */
vec2 equirect_uv(vec3 dir)
{
    const float pi = 3.14159265358979;
    float u = 0.5 + atan(dir.x, -dir.z) / (2.0 * pi);
    float v = acos(clamp(dir.y, -1.0, 1.0)) / pi;
    return vec2(u, v);
}

vec3 radiance(vec3 dir, float lod)
{
    if (frame.background_kind == GLOBALS_COLOR)
        return frame.background_color;
    if (frame.background_kind == GLOBALS_ENVIRONMENT)
        return textureLod(environment, equirect_uv(dir), lod).rgb;
    return sky_radiance(dir);
}

void main()
{
    color = vec4(radiance(normalize(dir), push.environment_lod), push.inverse != 0u ? 0.0 : 1.0);
}
