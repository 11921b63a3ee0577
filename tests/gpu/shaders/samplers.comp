/* samplers.comp: one image through several samplers, where they differ. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(binding = DATA_SAMPLERS) uniform sampler2D nearest;
layout(binding = DATA_SAMPLERS + 1) uniform sampler2D repeat_u;
layout(binding = DATA_SAMPLERS + 2) uniform sampler2D repeat_v;
layout(binding = DATA_SAMPLERS + 3) uniform sampler2D linear;
layout(binding = DATA_SAMPLERS + 4) uniform sampler2D mips;
layout(binding = DATA_SAMPLERS + 5) uniform sampler2D linear_mips;
layout(binding = DATA_SAMPLERS + 6) uniform sampler2D anisotropic;

layout(binding = DATA_COLORS, scalar) writeonly buffer Colors
{
    vec4 colors[];
};

void main()
{
    const vec2 outside = vec2(1.375, 1.25); /* texel (5, 2) of 4 x 2 */
    const vec2 between = vec2(0.5, 0.25);   /* texels (1, 0) and (2, 0) */
    const vec2 inside = vec2(0.375, 0.25);  /* texel (1, 0); (0, 0) of mip 1, three quarters */
    colors[0] = textureLod(nearest, outside, 0);
    colors[1] = textureLod(repeat_u, outside, 0);
    colors[2] = textureLod(repeat_v, outside, 0);
    colors[3] = textureLod(linear, between, 0);
    colors[4] = textureLod(nearest, inside, 1);
    colors[5] = textureLod(mips, inside, 1);
    colors[6] = textureLod(linear_mips, inside, 0.5);
    colors[7] = textureLod(anisotropic, inside, 0.5);
}
