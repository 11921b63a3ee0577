/* add.comp: adds an image's numbers to those of a buffer. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_TEXELS, r32ui) uniform readonly uimage2D texels;

layout(binding = DATA_NUMBERS, scalar) buffer Numbers
{
    uint numbers[];
};

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    numbers[at.y * imageSize(texels).x + at.x] += imageLoad(texels, at).r;
}
