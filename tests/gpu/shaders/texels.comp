/* texels.comp: twice the numbers of a buffer of texels, from the last one to the first. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_TEXELS) uniform usamplerBuffer texels;

layout(binding = DATA_NUMBERS, scalar) writeonly buffer Numbers
{
    uint numbers[];
};

void main()
{
    uvec2 size = gl_NumWorkGroups.xy * DATA_GROUP;
    int at = int(gl_GlobalInvocationID.y * size.x + gl_GlobalInvocationID.x);
    numbers[at] = 2u * texelFetch(texels, int(size.x * size.y) - 1 - at).r;
}
