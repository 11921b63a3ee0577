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

vec3 radiance(vec3 dir, float lod)
{
    if (frame.background_kind == GLOBALS_COLOR)
        return frame.background_color;
    if (frame.background_kind == GLOBALS_ENVIRONMENT)
        return textureLod(environment, background_uv(dir), lod).rgb;
    return sky_radiance(dir);
}

void main()
{
    color = vec4(radiance(normalize(dir), push.environment_lod), push.inverse != 0u ? 0.0 : 1.0);
}
