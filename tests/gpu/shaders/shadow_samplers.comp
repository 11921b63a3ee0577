/* shadow_samplers.comp: samplers that compare, mirror, have a border, or change the mip level. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(binding = DATA_SAMPLERS) uniform sampler2DShadow shadow;
layout(binding = DATA_SAMPLERS + 1) uniform sampler2D mirror;
layout(binding = DATA_SAMPLERS + 2) uniform sampler2D border;
layout(binding = DATA_SAMPLERS + 3) uniform sampler2D biased;
layout(binding = DATA_SAMPLERS + 4) uniform sampler2D from_mip_1;
layout(binding = DATA_SAMPLERS + 5) uniform sampler2D to_mip_0;
layout(binding = DATA_SAMPLERS + 6) uniform sampler2D greatest;
layout(binding = DATA_SAMPLERS + 7) uniform sampler2D own;

layout(binding = DATA_COLORS, scalar) writeonly buffer Colors
{
    vec4 colors[];
};

void main()
{
    const vec2 outside = vec2(1.375, 0.25); /* texel (5, 0) of 4 x 2 */
    const vec2 between = vec2(0.5, 0.25);   /* texels (1, 0) and (2, 0) */
    const vec2 inside = vec2(0.375, 0.25);  /* texel (1, 0); (0, 0) of mip 1 */
    /* between depths of .4 and .6 */
    colors[0] = vec4(textureLod(shadow, vec3(between, 0.5), 0));
    colors[1] = textureLod(mirror, outside, 0);
    colors[2] = textureLod(border, outside, 0);
    colors[3] = textureLod(biased, inside, 0);
    colors[4] = textureLod(from_mip_1, inside, 0);
    colors[5] = textureLod(to_mip_0, inside, 1);
    colors[6] = textureLod(greatest, between, 0);
    colors[7] = textureLod(own, outside, 0);
}
