/* contact.glsl: what objects hide of the light on a surface, and bring to it, by the map of
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

/* Changes a surface's light by what objects hide and bring; `around`: the light on its matt base.
 * Where it is so smooth that mirror.c shows the objects in it, its glossy light is left to that. */
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
