/* next.frag: the number behind, plus the seed. */
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/gpu/shaders/data.h"

layout(binding = DATA_TEXELS) uniform usampler2D texels;
layout(location = 0) out uint number;

layout(binding = DATA_SEED, scalar) uniform Seed
{
    data_seed seed;
};

void main()
{
    number = texelFetch(texels, ivec2(gl_FragCoord.xy), 0).r + seed.value;
}
