/* ao.glsl: ambient occlusion and bounced light of objects on surroundings, from
 * ao_map.frag. */
#ifndef AO_GLSL
#define AO_GLSL
#include "lib/brdf_shading.glsl"
#include "lighting/ao.h"

layout(set = 0, binding = AO_BINDING, scalar) uniform Contact
{
    ao_occluders ao;
};

layout(set = 0, binding = AO_MAP) uniform sampler2D ao_map;

/* Applies occlusion and bounced light of the objects to diffuse and specular light; `around` is the
 * irradiance. Specular light of smooth surfaces is left to screen-space reflections (ssr.c). */
void ao_shade(lit_surface s, lit_environment_factors shares, vec3 point, vec3 n, vec3 around,
              inout vec3 matt, inout vec3 glossy)
{
    if (constant_ao == 0u)
        return;
    vec3 off = point - ao.middle;
    vec4 found = textureLod(ao_map, 0.5 + 0.5 * off.xz / ao.half_side, 0.0);
    float level = clamp(2.0 - 2.0 * abs(off.y) / ao.height, 0.0, 1.0);
    float weight = level * max(n.y, 0.0);
    vec3 sun = sky_sun() * max(dot(n, frame.sun_dir), 0.0);
    vec3 ground = shares.matt * (around + sun) + s.f0 * around;
    vec3 change = weight * (found.rgb + found.a * ground);
    matt = max(matt + shares.matt * change, 0.0);
    glossy *= mix(vec3(1.0), clamp(1.0 + change / max(around, 1e-6), 0.0, 2.0),
                  smoothstep(0.4, 0.6, s.roughness));
}

#endif
