/* array.comp: an array of descriptors, and a descriptor set of the program's own. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_IMAGE) uniform usampler2D sources[3];

layout(binding = DATA_NUMBERS, scalar) writeonly buffer Numbers
{
    uint numbers[];
};

layout(set = 1, binding = 0, scalar) readonly buffer Own
{
    uint own[];
};

void main()
{
    uvec2 size = gl_NumWorkGroups.xy * DATA_GROUP;
    uvec2 at = gl_GlobalInvocationID.xy;
    uint sum = own[0];
    for (uint i = 0; i < own.length() - 1; i++) /* a dynamic index */
        sum += own[i + 1] * textureLod(sources[i], (vec2(at) + 0.5) / vec2(size), 0.0).r;
    numbers[at.y * size.x + at.x] = sum;
}
