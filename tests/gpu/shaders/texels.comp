/* texels.comp: twice the numbers of a buffer of texels in another one, backwards. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_TEXELS) uniform usamplerBuffer texels;

layout(binding = DATA_NUMBERS, r32ui) uniform writeonly uimageBuffer numbers;

void main()
{
    uvec2 size = gl_NumWorkGroups.xy * DATA_GROUP;
    int at = int(gl_GlobalInvocationID.y * size.x + gl_GlobalInvocationID.x);
    imageStore(numbers, at, uvec4(2u * texelFetch(texels, int(size.x * size.y) - 1 - at).r));
}
