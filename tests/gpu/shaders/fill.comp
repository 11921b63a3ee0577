/* fill.comp: numbers each texel of an image, and three times that in a buffer. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_TEXELS, r32ui) uniform writeonly uimage2D texels;

layout(binding = DATA_SEED, scalar) uniform Seed
{
    data_seed seed;
};

layout(binding = DATA_NUMBERS, scalar) writeonly buffer Numbers
{
    uint numbers[];
};

void main()
{
    uvec2 at = gl_GlobalInvocationID.xy;
    uint index = at.y * gl_NumWorkGroups.x * DATA_GROUP + at.x;
    imageStore(texels, ivec2(at), uvec4(seed.value + index));
    numbers[index] = 3 * (seed.value + index);
}
