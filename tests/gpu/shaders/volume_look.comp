/* volume_look.comp: both mips of an image of three dimensions, turned around. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_IMAGE) uniform usampler3D volume;

layout(binding = DATA_NUMBERS, scalar) writeonly buffer Numbers
{
    uint numbers[];
};

uint fetch(ivec3 at, int mip)
{
    ivec3 size = textureSize(volume, mip);
    return texelFetch(volume, size - 1 - at % size, mip).r;
}

void main()
{
    ivec3 at = ivec3(gl_GlobalInvocationID);
    ivec3 size = textureSize(volume, 0);
    numbers[(at.z * size.y + at.y) * size.x + at.x] = fetch(at, 0) + 1000 * fetch(at, 1);
}
