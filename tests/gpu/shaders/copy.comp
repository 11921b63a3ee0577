/* copy.comp: a buffer's numbers, written to an image. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_TEXELS, r32ui) uniform writeonly uimage2D texels;

layout(binding = DATA_NUMBERS, scalar) readonly buffer Numbers
{
    uint numbers[];
};

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    imageStore(texels, at, uvec4(numbers[at.y * imageSize(texels).x + at.x]));
}
