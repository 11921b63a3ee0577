/* caustics_copy.frag: fragment shader that copies the light map of pool caustics. */
#version 460
#include "water/caustics.h"

layout(set = 0, binding = CAUSTICS_RAW) uniform sampler2D raw;

layout(location = 0) out float light;

void main()
{
    light = texelFetch(raw, ivec2(gl_FragCoord.xy), 0).r;
}
