/* surroundings_materials.frag: fragment shader of surroundings with materials. With
 * SURROUNDINGS_CAUSTICS, adds the ice's caustics and shadow. With SURROUNDINGS_EXTRA, reads the
 * attributes of struct mesh_extra. With SURROUNDINGS_SSR, writes inputs of reflections. */
#version 460
#include "lib/alpha_test.glsl"
#include "lib/ao.glsl"
#include "lib/brdf_shading.glsl"
#include "lib/octahedral_encoding.glsl"
#include "mesh_layout.h"
#include "surroundings/surroundings.h"

layout(push_constant, scalar) uniform Push
{
    surroundings_push push;
};

layout(location = 0) in vec3 eye_to_point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 base_color;
layout(location = 3) in vec2 uv;
layout(location = 4) flat in uint material;
#ifdef SURROUNDINGS_EXTRA
layout(location = 5) in vec2 other_uv;
layout(location = 6) in vec4 tangent;
#endif
layout(location = 0) out vec4 color;
#ifdef SURROUNDINGS_SSR
layout(location = SURROUNDINGS_OUT_SURFACE) out vec4 out_surface;
layout(location = SURROUNDINGS_OUT_SPECULAR) out vec4 out_specular;
#endif

/* Returns the unnormalised view vector towards the shaded point. */
vec3 view_vector()
{
    return constant_orthographic != 0u && push.inverse == 0u ? push.forward : eye_to_point;
}

#ifdef SURROUNDINGS_CAUSTICS
#include "lib/sun_shadow_caustics.glsl"
#endif

/* Returns a factor on the texture footprint that replaces anisotropic filtering in cube maps. The
 * factor is the square root of the footprint's width over its length, at least 1/2. */
float footprint_blur()
{
    vec2 x = dFdx(uv), y = dFdy(uv);
    float longer = max(dot(x, x), dot(y, y));
    float area = abs(x.x * y.y - x.y * y.x);
    return longer > 0.0 ? clamp(sqrt(area / longer), 0.5, 1.0) : 1.0;
}

/* Returns the sunlight on the surface; sets `caustics` to the part that the ice has refracted. */
vec3 sun_light(out vec3 caustics)
{
    caustics = vec3(0.0);
#ifdef SURROUNDINGS_CAUSTICS
    sun_shadow shadow = sun_shadow_at(push.eye + eye_to_point, normalize(normal));
    caustics = sky_sun() * shadow.refracted;
    return sky_sun() * (shadow.direct * shadow.visibility) + caustics;
#else
    return sky_sun();
#endif
}

/* Adds a clear coat over the base in the outputs. `n` is the normal without the normal map, `sun`
 * the sunlight and `base_specular` the factors of the base's specular environment light. */
void add_coat(lit_material m, vec3 n, vec3 to_eye, float lod, vec3 sun, vec3 base_specular)
{
    lit_coat c = lit_coat_of(m, push.eye + eye_to_point, n, to_eye, lod, sun, frame.sun_spread);
    float rest = 1.0 - c.reflectance;
    vec3 coat_light = c.reflectance * m.occlusion * c.environment;
    color.rgb = rest * color.rgb + coat_light + c.direct;
#ifdef SURROUNDINGS_SSR
    out_surface.w *= rest;
    out_specular *= rest;
    if (lit_coat_is_stronger(c.reflectance, rest * base_specular)) {
        out_surface = vec4(octahedral_encode(n), m.coat_roughness, c.reflectance * m.occlusion);
        out_specular = vec4(coat_light, 0.0);
    }
#endif
}

/* Returns the background that a shadow catcher shows in direction `dir`; white if the image has no
 * background. */
vec3 catcher_background(vec3 dir)
{
    if (constant_backdrop != GLOBALS_BACKDROP_ENVIRONMENT && push.inverse == 0u)
        return constant_backdrop == GLOBALS_BACKDROP_COLOR ? frame.background_color : vec3(1.0);
    return environment_radiance(environment, dir, push.environment_lod);
}

/* Makes a shadow catcher transparent in an image without background. Shadows are black with an
 * alpha; light of caustics is added to the background, with alpha 0. */
void make_catcher_transparent(vec3 dir)
{
    if (constant_backdrop != GLOBALS_BACKDROP_NONE || push.inverse != 0u)
        return;
    vec3 factor = color.rgb;
    float mean = dot(factor, vec3(1.0 / 3.0));
    vec3 background = environment_radiance(environment, dir, push.environment_lod);
    color = vec4(max(factor - 1.0, 0.0) * background, clamp(1.0 - mean, 0.0, 1.0));
}

void main()
{
#ifdef SURROUNDINGS_EXTRA
    lit_second_uv = other_uv;
    lit_tangent = tangent;
#endif
    uint row = material >> MESH_SURFACE_SHIFT;
    float tiled = constant_tiled != 0u ? exp2(frame.lod_bias) : 1.0;
    float blur = push.inverse != 0u ? footprint_blur() : tiled;
    vec4 base = lit_base(row, material & MESH_TEXTURE_MASK, uv, blur);
    vec3 albedo = base_color * base.rgb;
    lit_material m = lit_material_at(row, uv, blur, albedo, 0.0);
    lit_surface s = m.surface;
    float alpha = push.inverse != 0u ? 1.0 / length(eye_to_point) : 1.0;
    vec3 to_eye = -normalize(view_vector());
    vec3 n = normalize(normal);
    n = dot(n, to_eye) < 0.0 ? -n : n;
    vec3 top = n; /* specular lobe's normal; `n`: diffuse base's */
    vec3 unmapped = n;
    if (m.normal_texel != vec4(1.0))
        n = NORMAL_MAP(row, n, normal, m.normal_texel.rgb, m.scales.x, eye_to_point, uv);
    top = m.scales.w > 0.0 ? top : n;
    vec3 reflected_dir = reflect(-to_eye, top);
    float lod = lit_mirror_lod(reflected_dir, push.environment_lod);
    float coat_lod =
        lit_has_coats() ? lit_mirror_lod(reflect(-to_eye, unmapped), push.environment_lod) : lod;
    if (is_hole(base.a, row))
        discard;
    bool is_catcher = lit_is_shadow_catcher(row);
    if (is_catcher)
        s.diffuse = lit_catcher_albedo(n, catcher_background(-to_eye));
    vec3 caustics;
    vec3 sun = sun_light(caustics);
#ifdef SURROUNDINGS_SSR
    out_surface = out_specular = vec4(0.0);
#endif
    if ((material & MESH_UNLIT) != 0u) {
        color = vec4(albedo * (1.0 + caustics * max(dot(n, frame.sun_dir), 0.0)), alpha);
        return;
    }
    float n_dot_v = clamp(dot(top, to_eye), 0.0, 1.0);
    lit_environment_factors env = lit_environment_factors_of(s, lit_split(s.roughness, n_dot_v));
    vec3 specular_light = env.specular * lit_specular(reflected_dir, s.roughness, lod);
    vec3 unoccluded_diffuse = lit_diffuse(n), diffuse_light = env.diffuse * unoccluded_diffuse;
    ao_shade(s, env, push.eye + eye_to_point, n, unoccluded_diffuse, diffuse_light, specular_light);
    vec3 lit = sun * lit_by_light_on(s, top, n, to_eye, frame.sun_dir, frame.sun_spread);
    lit += lit_by_lights_on(s, push.eye + eye_to_point, top, n, to_eye);
    color = vec4((specular_light + diffuse_light) * m.occlusion + lit + m.emission, alpha);
#ifdef SURROUNDINGS_SSR
    float reflectance_mean = dot(env.specular, vec3(1.0 / 3.0));
    out_surface = vec4(octahedral_encode(top), s.roughness, reflectance_mean * m.occlusion);
    out_specular = vec4(specular_light * m.occlusion, 0.0);
#endif
    if (is_catcher)
        make_catcher_transparent(-to_eye);
    if (lit_has_coats() && m.coat > 0.0)
        add_coat(m, unmapped, to_eye, coat_lod, sun, env.specular);
}
