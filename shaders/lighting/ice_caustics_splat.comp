/* ice_caustics_splat.comp: compute shader that adds the photons of ice caustics to the counts. */
#version 460
#include "lighting/ice_caustics.h"

layout(local_size_x = ICE_CAUSTICS_GROUP, local_size_y = ICE_CAUSTICS_GROUP) in;
layout(set = 0, binding = ICE_CAUSTICS_LANDED) uniform sampler2D landing_red;
layout(set = 0, binding = ICE_CAUSTICS_LANDED + 1) uniform sampler2D landing_green;
layout(set = 0, binding = ICE_CAUSTICS_LANDED + 2) uniform sampler2D landing_blue;
layout(set = 0, binding = ICE_CAUSTICS_REFLECTED) uniform sampler2D landing_reflected;
layout(set = 0, binding = ICE_CAUSTICS_LATER) uniform sampler2D landing_later;
layout(set = 0, binding = ICE_CAUSTICS_COUNTS, r32ui) uniform uimage2D counts;

/* Adds a photon to the map. Weights are integers, so photon order does not change the sum. */
void splat(vec4 landed, int channel)
{
    ivec2 texel = ivec2(floor(landed.xy * float(ICE_CAUSTICS_SIZE)));
    uint weight = uint(landed.z * ICE_CAUSTICS_WEIGHT + 0.5);
    if (weight > 0u && all(greaterThanEqual(texel, ivec2(0))) &&
        all(lessThan(texel, ivec2(ICE_CAUSTICS_SIZE))))
        imageAtomicAdd(counts, texel + ivec2(channel * ICE_CAUSTICS_SIZE, 0), weight);
}

/* Adds a branch that carries all channels. */
void splat_channels(vec4 landed)
{
    int at = int(landed.a);
    ivec2 texel = ivec2(at % ICE_CAUSTICS_SIZE, at / ICE_CAUSTICS_SIZE);
    for (int channel = 0; channel < 3; channel++) {
        uint weight = uint(landed[channel] * ICE_CAUSTICS_WEIGHT + 0.5);
        if (weight > 0u)
            imageAtomicAdd(counts, texel + ivec2(channel * ICE_CAUSTICS_SIZE, 0), weight);
    }
}

void main()
{
    ivec2 photon = ivec2(gl_GlobalInvocationID.xy);
    splat(texelFetch(landing_red, photon, 0), 0);
    splat(texelFetch(landing_green, photon, 0), 1);
    splat(texelFetch(landing_blue, photon, 0), 2);
    splat_channels(texelFetch(landing_reflected, photon, 0));
    splat_channels(texelFetch(landing_later, photon, 0));
}
