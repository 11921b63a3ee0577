#version 460
#extension GL_GOOGLE_include_directive : require
#include "water/caustics.h"

layout(set = 0, binding = CAUSTICS_RAW) uniform sampler2D raw;

layout(location = 0) out float light;

void main()
{
    light = texelFetch(raw, ivec2(gl_FragCoord.xy), 0).r;
}
