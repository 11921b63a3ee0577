/* ao.glsl: applies ambient occlusion and reflection by objects to surroundings
 * (ao_box_occluders.frag). */
#ifndef AO_GLSL
#define AO_GLSL
#include "lib/brdf_shading.glsl"
#include "lighting/ao.h"

layout(set = 0, binding = AO_BINDING, scalar) uniform Occluders
{
    ao_occluders ao;
};

layout(set = 0, binding = AO_MAP) uniform sampler2D ao_map;

/* Applies ambient occlusion and reflected light of objects to a surface's `diffuse` and `specular`
 * light. Keeps `specular` on smooth surfaces, because they show screen-space reflections. */
void ao_shade(lit_surface s, lit_environment_factors factors, vec3 point, vec3 n, vec3 irradiance,
              inout vec3 diffuse, inout vec3 specular)
{
    if (constant_ao == 0u)
        return;
    vec3 off = point - ao.center;
    vec4 found = textureLod(ao_map, 0.5 + 0.5 * off.xz / ao.half_side, 0.0);
    float level = clamp(2.0 - 2.0 * abs(off.y) / ao.height, 0.0, 1.0);
    float weight = level * max(n.y, 0.0);
    vec3 sun = sky_sun() * max(dot(n, frame.sun_dir), 0.0);
    vec3 ground = factors.diffuse * (irradiance + sun) + s.f0 * irradiance;
    vec3 change = weight * (found.rgb + found.a * ground);
    diffuse = max(diffuse + factors.diffuse * change, 0.0);
    specular *= mix(vec3(1.0), clamp(1.0 + change / max(irradiance, 1e-6), 0.0, 2.0),
                    smoothstep(0.4, 0.6, s.roughness));
}

#endif
