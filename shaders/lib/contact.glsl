/* contact.glsl: ambient occlusion and bounced light of objects on surroundings, from
 * contact_map.frag. */
#ifndef LIB_CONTACT_GLSL
#define LIB_CONTACT_GLSL
#include "contact.h"
#include "lib/lit.glsl"

layout(set = 0, binding = CONTACT_BINDING, scalar) uniform Contact
{
    contact_bodies contact;
};

layout(set = 0, binding = CONTACT_MAP) uniform sampler2D contact_map;

/* Applies occlusion and bounced light of the objects to diffuse and specular light; `around` is the
 * irradiance. Specular light of smooth surfaces is left to screen-space reflections (mirror.c). */
void contact_shade(lit_surface s, lit_shares shares, vec3 point, vec3 n, vec3 around,
                   inout vec3 matt, inout vec3 glossy)
{
    if (constant_contact == 0u)
        return;
    vec3 off = point - contact.middle;
    vec4 found = textureLod(contact_map, 0.5 + 0.5 * off.xz / contact.half_side, 0.0);
    float level = clamp(2.0 - 2.0 * abs(off.y) / contact.height, 0.0, 1.0);
    float weight = level * max(n.y, 0.0);
    vec3 sun = sky_sun() * max(dot(n, frame.sun_dir), 0.0);
    vec3 ground = shares.matt * (around + sun) + s.f0 * around;
    vec3 change = weight * (found.rgb + found.a * ground);
    matt = max(matt + shares.matt * change, 0.0);
    glossy *= mix(vec3(1.0), clamp(1.0 + change / max(around, 1e-6), 0.0, 2.0),
                  smoothstep(0.4, 0.6, s.roughness));
}

#endif
