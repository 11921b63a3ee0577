/* levels.comp: the first texel of every mip (x) of every layer (y) of an array. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(binding = DATA_IMAGE) uniform sampler2DArray image;

layout(binding = DATA_COLORS, scalar) writeonly buffer Colors
{
    vec4 colors[];
};

void main()
{
    uvec2 at = gl_WorkGroupID.xy;
    colors[at.y * gl_NumWorkGroups.x + at.x] = texelFetch(image, ivec3(0, 0, at.y), int(at.x));
}
