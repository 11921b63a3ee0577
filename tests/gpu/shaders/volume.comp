/* volume.comp: numbers each texel of a mip of an image of three dimensions. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(local_size_x = DATA_GROUP, local_size_y = DATA_GROUP) in;
layout(binding = DATA_TEXELS, r32ui) uniform writeonly uimage3D volume;

layout(binding = DATA_SEED, scalar) uniform Seed
{
    data_seed seed;
};

void main()
{
    ivec3 at = ivec3(gl_GlobalInvocationID);
    ivec3 size = imageSize(volume);
    if (all(lessThan(at, size)))
        imageStore(volume, at, uvec4(seed.value + (at.z * size.y + at.y) * size.x + at.x));
}
