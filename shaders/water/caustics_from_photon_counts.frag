/* caustics_from_photon_counts.frag: fragment shader that converts photon counts to light of pool
 * caustics. */
#version 460
#include "water/caustics.glsl"

layout(set = 0, binding = CAUSTICS_COUNTS) uniform usampler2D counts;

layout(location = 0) out float light;

void main()
{
    float count = float(texelFetch(counts, ivec2(gl_FragCoord.xy), 0).r) / CAUSTICS_WEIGHT;
    light = count * map_pool_texels() / float(push.caustics.photons);
}
