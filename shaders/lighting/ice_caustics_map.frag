/* ice_caustics_map.frag: fragment shader that filters photon counts into the ice's caustic map. */
#version 460
#include "lib/sun_light_space.glsl"

layout(set = 0, binding = ICE_CAUSTICS_COUNTS) uniform usampler2D counts;
layout(set = 0, binding = ICE_CAUSTICS_NORMAL) uniform sampler2D normal_front;

layout(location = 0) out vec4 map; /* rgb: caustics; a: ice coverage */

/* Returns a texel's accumulated photon weights in rgb and its coverage by ice in a. */
vec4 counted(ivec2 texel)
{
    ivec2 at = clamp(texel, ivec2(0), ivec2(ICE_CAUSTICS_SIZE - 1));
    vec4 found;
    for (int channel = 0; channel < 3; channel++)
        found[channel] = float(texelFetch(counts, at + ivec2(channel * ICE_CAUSTICS_SIZE, 0), 0).r);
    vec2 uv = (vec2(texel) + 0.5) / float(ICE_CAUSTICS_SIZE);
    found.a = ice_light_sample(normal_front, uv).w;
    return found;
}

/* Filters the photon counts with a 3 x 3 tent, which reduces noise and softens shadow edges. Scales
 * the counts by the texel area that one photon represents. */
void main()
{
    const float weights[3] = { 0.25, 0.5, 0.25 };
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 3; x++)
            sum += weights[x] * weights[y] * counted(texel + ivec2(x - 1, y - 1));
    }
    float photon = float(ICE_CAUSTICS_SIZE) / (float(ICE_CAUSTICS_PHOTONS) * light.reach);
    map.rgb = sum.rgb * (photon * photon / ICE_CAUSTICS_WEIGHT);
    map.rgb = min(map.rgb, vec3(65504.0)); /* focused light may exceed half floats */
    map.a = sum.a;
}
