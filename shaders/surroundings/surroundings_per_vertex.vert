/* surroundings_per_vertex.vert: vertex shader of surroundings lit per vertex, without normal maps.
 * With SURROUNDINGS_EXTRA, reads the attributes of struct mesh_extra. With SURROUNDINGS_CAUSTICS,
 * writes outputs for the ice's caustics and shadow. Passes uniforms on as flat outputs, because
 * lavapipe's fragment shaders fetch each float of a uniform separately. */
#version 460
#define LIT_PER_VERTEX
#include "lib/ao.glsl"
#include "lib/brdf_shading.glsl"
#include "lib/object_pose.glsl"
#include "surroundings/surroundings.h"
#ifdef SURROUNDINGS_EXTRA
#include "lib/vertex_tangent_uv1.glsl"
#endif
#ifdef SURROUNDINGS_CAUSTICS
#include "lib/sun_light_space.glsl"
#endif

layout(push_constant, scalar) uniform Push
{
    surroundings_push push;
};

layout(location = MESH_POSITION) in vec3 position;
layout(location = MESH_NORMAL) in vec3 normal;
layout(location = MESH_COLOR) in vec3 color;
layout(location = MESH_UV) in vec2 uv;
layout(location = MESH_MATERIAL) in uint material;

layout(location = 0) flat out uint out_material;
layout(location = 1) out vec3 out_diffuse;
layout(location = 2) out vec3 out_specular;
layout(location = 3) out vec2 out_uv;
layout(location = 4) out vec2 out_glow_uv;
layout(location = 5) flat out vec4 out_lookups;
#ifdef SURROUNDINGS_CAUSTICS
layout(location = 6) out vec3 out_sun;
layout(location = 7) out vec4 out_shadow_clip;
layout(location = 8) flat out float out_direct;
layout(location = 9) out vec4 out_shadow_clip_lifted;
#endif

/* Returns the radiance that a surface reflects, except direct sunlight. */
vec3 radiance(lit_surface s, vec3 point, vec3 n, vec3 to_eye, float occlusion)
{
    lit_environment_factors env =
        lit_environment_factors_of(s, lit_split(s.roughness, clamp(dot(n, to_eye), 0.0, 1.0)));
    vec3 mirror = lit_specular(reflect(-to_eye, n), s.roughness, push.environment_lod);
    vec3 unoccluded_diffuse = lit_diffuse(n), diffuse = env.diffuse * unoccluded_diffuse,
         specular = env.specular * mirror;
    ao_shade(s, env, point, n, unoccluded_diffuse, diffuse, specular);
    return occlusion * (specular + diffuse) + lit_by_lights(s, point, n, to_eye);
}

/* Texture coordinates, array layer and wrap mode of a material's texture. */
struct texture_lookup {
    vec2 uv;
    float layer; /* -1 if there is no texture */
    float wraps; /* wrap mode for lit_wrapped() */
};

texture_lookup texture_lookup_of(uint row, int use)
{
    vec4 u = material_texel(row, MATERIAL_ROW_TEXTURES + 2 * use);
    vec4 v = material_texel(row, MATERIAL_ROW_TEXTURES + 2 * use + 1);
    bool is_other = v.w >= float(MATERIAL_OTHER_SET);
    vec2 lookup_uv = uv;
#ifdef SURROUNDINGS_EXTRA
    lookup_uv = is_other ? lit_second_uv : uv;
#endif
    vec2 at = vec2(dot(u.xyz, vec3(lookup_uv, 1.0)), dot(v.xyz, vec3(lookup_uv, 1.0)));
    return texture_lookup(at, u.w - 1.0, is_other ? v.w - float(MATERIAL_OTHER_SET) : v.w);
}

/* Writes the texture coordinates, layers and wrap modes that the fragment shader needs. */
void write_texture_lookups(uint row)
{
    uint layer = material & MESH_TEXTURE_MASK;
    texture_lookup base = texture_lookup_of(row, MATERIAL_BASE_COLOR);
    texture_lookup emissive = texture_lookup_of(row, MATERIAL_EMISSION);
    if (base.layer < 0.0)
        base = texture_lookup(uv, float(layer) - 1.0, float(MATERIAL_REPEAT));
    out_uv = base.uv;
    out_glow_uv = emissive.uv;
    out_lookups = vec4(base.layer, base.wraps, emissive.layer, emissive.wraps);
}

/* Computes a vertex's lighting and returns the sunlight on the diffuse base. The base colour
 * texture is left out of diffuse light, because the fragment shader applies it. */
vec3 write_lighting(uint row, vec3 point, vec3 n, vec3 to_eye)
{
    vec3 base = lit_base(row, material & MESH_TEXTURE_MASK, uv, 1.0).rgb;
    lit_material m = lit_material_at(row, uv, 1.0, color * base, 0.0);
    lit_surface s = m.surface;
    s.diffuse = vec3(0.0);
    vec3 reflected = radiance(s, point, n, to_eye, m.occlusion);
    vec3 highlight = lit_by_light(s, n, to_eye, frame.sun_dir, frame.sun_spread);
    s.diffuse = color * (1.0 - m.metallic);
    if (lit_is_shadow_catcher(row))
        s.diffuse =
            lit_catcher_albedo(n, environment_radiance(environment, -to_eye, push.environment_lod));
    out_diffuse = radiance(s, point, n, to_eye, m.occlusion) - reflected;
    out_specular = reflected + sky_sun() * highlight;
    if ((constant_textured & 1u << MATERIAL_EMISSION) == 0u)
        out_specular += material_texel(row, MATERIAL_ROW_EMISSION).rgb;
    vec3 sun =
        sky_sun() * (lit_by_light(s, n, to_eye, frame.sun_dir, frame.sun_spread) - highlight);
    if (lit_has_coats()) {
        lit_coat c =
            lit_coat_of(m, point, n, to_eye, push.environment_lod, sky_sun(), frame.sun_spread);
        float base_fraction = 1.0 - c.reflectance;
        out_diffuse *= base_fraction;
        out_specular *= base_fraction;
        out_specular += c.reflectance * m.occlusion * c.environment + c.direct;
        sun *= base_fraction;
    }
    return sun;
}

void main()
{
    /* `precise`, because the AOV passes test for equal depth */
    precise vec3 point = pose_surroundings(position, material);
    precise vec4 clip = push.clip_from_world * vec4(point, 1.0);
    gl_Position = clip;
    vec3 n = normalize(pose_surroundings_normal(normal, material));
    vec3 to_eye = -normalize(constant_orthographic != 0u ? push.forward : point - push.eye);
    n = dot(n, to_eye) < 0.0 ? -n : n;
    uint row = material >> MESH_SURFACE_SHIFT;
    out_material = material;
#ifdef SURROUNDINGS_EXTRA
    lit_second_uv = vertex_extra_texel(1).xy;
#endif
    write_texture_lookups(row);
    out_diffuse = color;
    out_specular = vec3(0.0);
    bool is_lit = (material & MESH_UNLIT) == 0u;
    vec3 sun = is_lit ? write_lighting(row, point, n, to_eye) : vec3(0.0);
#ifdef SURROUNDINGS_CAUSTICS
    /* Unlit surfaces need the sunlight, too, because caustics are relative to sunlight. */
    out_sun = is_lit ? sun : sky_sun() * color * max(dot(n, frame.sun_dir), 0.0);
    out_shadow_clip = ice_light_clip(point);
    out_shadow_clip_lifted = ice_light_clip(ice_light_biased(point, n));
    out_direct = is_lit ? 1.0 : 0.0;
#else
    out_diffuse += sun;
#endif
}
