/* caustics_photons.comp: compute shader that traces photons of pool caustics from the sun. */
#version 460
#include "water/caustics.glsl"

layout(local_size_x = CAUSTICS_GROUP_1D) in;
layout(set = 0, binding = CAUSTICS_COUNTS, r32ui) uniform uimage2D counts;

/* Returns four random numbers from 0 to 1 for a photon (pcg4d, Jarzynski and Olano 2020). */
vec4 random(uint index)
{
    uvec4 v = uvec4(index, 1u + sample_seed(), 2u, 3u) * 1664525u + 1013904223u;
    for (int i = 0; i < 2; i++) {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
        v ^= v >> 16u;
    }
    return vec4(v >> 8u) / 16777216.0;
}

/* Traces one photon from a random point of the sun through a random point of the surface. Photon
 * weights are integers, because integer sums do not depend on the order of photons. */
void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= push.caustics.photons)
        return;
    vec4 r = random(index);
    float angle = 2.0 * pi * r.w;
    vec3 landed =
        land((r.xy - 0.5) * push.pool.size, sun_disc(sqrt(r.z) * vec2(cos(angle), sin(angle))));
    ivec2 texel = ivec2(floor((landed.xy - map_region().xy) / map_texel_size()));
    if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(CAUSTICS_SIZE))))
        imageAtomicAdd(counts, texel, uint(landed.z * CAUSTICS_WEIGHT + 0.5));
}
