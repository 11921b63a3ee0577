/* surroundings.frag: fragment shader of surroundings without materials;
 * SURROUNDINGS_CAUSTICS adds the caustics and shadow of the ice. */
#version 460
#include "lib/globals.glsl"
#include "lib/procedural_sky.glsl"
#include "lib/specialization_constants.glsl"
#include "mesh_layout.h"
#include "surroundings/surroundings.h"

layout(push_constant, scalar) uniform Push
{
    surroundings_push push;
};

layout(set = 0, binding = SURROUNDINGS_TEXTURES) uniform sampler2DArray textures;

layout(location = 0) in vec3 eye_to_point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base_color;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
layout(location = 0) out vec4 color;

/* Returns the unnormalised view vector towards the shaded point. */
vec3 view_vector()
{
    return constant_orthographic != 0u && push.inverse == 0u ? push.forward : eye_to_point;
}

#ifdef SURROUNDINGS_CAUSTICS
#include "lib/sun_shadow_caustics.glsl"

/* Returns the irradiance of a surface. The colour of unlit surfaces includes baked lighting, so
 * only the ice's caustics are added. */
vec3 light_on(vec3 n, bool unlit)
{
    sun_shadow shadow = sun_shadow_at(push.eye + eye_to_point, n);
    vec3 sun = sky_sun() * max(dot(n, frame.sun_dir), 0.0);
    return unlit ? 1.0 + sun * shadow.refracted
                 : sky_ambient(n) + sun * (shadow.direct * shadow.visibility + shadow.refracted);
}
#else
vec3 light_on(vec3 n, bool unlit)
{
    return constant_lit == 0u || unlit ? vec3(1.0) : sky_light(n);
}
#endif

/* Shades double-sided diffuse surfaces whose albedo is vertex colour times texture. */
void main()
{
    uint layer = material & MESH_TEXTURE_MASK;
    vec3 albedo = base_color;
    if (constant_textured != 0u && layer != 0u) {
        vec3 at = vec3(uv, float(layer - 1u));
        vec4 texel = texture(textures, at);
        if (constant_tiled != 0u && push.inverse == 0u)
            texel = texture(textures, at, frame.lod_bias);
        if ((material & MESH_CUTOUT) != 0u && texel.a < 0.5)
            discard;
        albedo *= texel.rgb;
    }
    vec3 n = normalize(normal);
    albedo *= light_on(dot(n, view_vector()) > 0.0 ? -n : n, (material & MESH_UNLIT) != 0u);
    color = vec4(albedo, push.inverse != 0u ? 1.0 / length(eye_to_point) : 1.0);
}
