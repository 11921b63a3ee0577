#version 460
#extension GL_GOOGLE_include_directive : require
#include "water/caustics.glsl"

layout(set = 0, binding = CAUSTICS_COUNTS) uniform usampler2D counts;

layout(location = 0) out float light;

void main()
{
    float count = float(texelFetch(counts, ivec2(gl_FragCoord.xy), 0).r) / CAUSTICS_WEIGHT;
    light = count * map_pool_texels() / float(push.caustics.photons);
}
