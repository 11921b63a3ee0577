/* brdf_shading.glsl: shading by brdf.h: normal maps, environment light and punctual lights. */
#ifndef BRDF_SHADING_GLSL
#define BRDF_SHADING_GLSL
#include "lib/environment_radiance.glsl"
#include "surroundings/surroundings.h"
#define LIT_ENVIRONMENT_BINDING SURROUNDINGS_ENVIRONMENT_LIGHT
#include "brdf.h"
#include "lib/environment_diffuse.glsl"
#include "lib/material_textures.glsl"

layout(set = 0, binding = SURROUNDINGS_ENVIRONMENT) uniform sampler2D environment;
layout(set = 0, binding = SURROUNDINGS_DATA_TEXTURES) uniform sampler2DArray data_textures;
layout(set = 0, binding = SURROUNDINGS_BRDF_TABLE) uniform sampler2D splits;
layout(set = 0, binding = SURROUNDINGS_LIGHTS) uniform sampler2D lights;

/* Returns the bitangent for a vertex tangent with handedness in w. `n` is the unit normal on either
 * side of the surface. `outward` is the vertex normal. */
vec3 normal_map_bitangent(vec3 n, vec3 outward, vec4 tangent)
{
    return sign(tangent.w) * (dot(n, outward) < 0.0 ? -1.0 : 1.0) * cross(n, tangent.xyz);
}

/* Returns `n` perturbed by a normal map; `u_dir`, `minus_v_dir` are the directions of u and -v. */
vec3 normal_map_by_axes(vec3 n, vec3 texel, float scale, vec3 u_dir, vec3 minus_v_dir)
{
    vec3 slope = vec3((2.0 * texel.xy - 1.0) * scale, 2.0 * texel.z - 1.0);
    vec3 tangent = u_dir - n * dot(n, u_dir);
    if (dot(tangent, tangent) == 0.0)
        return n;
    tangent = normalize(tangent);
    vec3 bitangent = cross(n, tangent);
    bitangent *= dot(bitangent, minus_v_dir) < 0.0 ? -1.0 : 1.0;
    return normalize(slope.x * tangent + slope.y * bitangent + slope.z * n);
}

#if !defined LIT_NO_DERIVATIVES && !defined LIT_PER_VERTEX
/* Returns normal `n` perturbed by a normal map, with a tangent from screen-space derivatives. */
vec3 normal_map_by_derivatives(vec3 n, vec3 texel, float scale, vec3 point, vec2 uv)
{
    vec3 point_x = dFdx(point), point_y = dFdy(point);
    vec2 uv_x = dFdx(uv), uv_y = dFdy(uv);
    float side = sign(uv_x.x * uv_y.y - uv_y.x * uv_x.y);
    vec3 u_dir = side * (point_x * uv_y.y - point_y * uv_x.y);
    vec3 minus_v_dir = side * (point_x * uv_y.x - point_y * uv_x.x);
    return normal_map_by_axes(n, texel, scale, u_dir, minus_v_dir);
}

/* Perturbs a normal by a material's normal map; `outward` is the vertex normal. */
#ifdef SURROUNDINGS_EXTRA
#define NORMAL_MAP(row, n, outward, texel, scale, point, uv) \
    normal_map_by_tangent(row, n, outward, texel, scale, point, uv)

vec3 normal_map_by_tangent(uint row, vec3 n, vec3 outward, vec3 texel, float scale, vec3 point,
                           vec2 uv)
{
    vec4 v = material_texel(row, MATERIAL_ROW_TEXTURES + 2 * MATERIAL_NORMAL + 1);
    vec2 normal_uv = v.w >= float(MATERIAL_OTHER_SET) ? lit_second_uv : uv;
    vec3 bitangent = normal_map_bitangent(n, outward, lit_tangent);
    if (bitangent == vec3(0.0)) /* also if lit_tangent.w is 0 */
        return normal_map_by_derivatives(n, texel, scale, point, normal_uv);
    return normal_map_by_axes(n, texel, scale, lit_tangent.xyz, bitangent);
}
#else
#define NORMAL_MAP(row, n, outward, texel, scale, point, uv) \
    normal_map_by_derivatives(n, texel, scale, point, uv)
#endif
#endif

/* ---- material ---- */

/* Parameters of a material at a surface point, multiplied by the material's textures. */
struct lit_material {
    lit_surface surface;
    float metallic, occlusion;
    vec3 emission;
    vec4 normal_texel;          /* of the normal map; 1 if there is none */
    vec4 scales;                /* MATERIAL_ROW_SCALES */
    float coat, coat_roughness; /* clear coat's factor, 0 if there is none, and its roughness */
};

bool lit_has_coats()
{
    return (constant_textured & CONSTANT_TEXTURED_COAT) != 0u;
}

/* Samples a material. `albedo` includes the base colour texture. `ior` is the refractive index of a
 * water layer above, or 0. Water reduces specular reflection (lit_reflectance_in_medium()). */
lit_material lit_material_at(uint row, vec2 uv, float blur, vec3 albedo, float ior)
{
    vec4 factors = material_texel(row, MATERIAL_ROW_FACTORS);
    vec4 rough = lit_texel(data_textures, row, MATERIAL_METALLIC_ROUGHNESS, uv, blur);
    float specular = lit_texel(data_textures, row, MATERIAL_SPECULAR, uv, blur).a * factors.z;
    vec3 f0 = lit_texel(textures, row, MATERIAL_SPECULAR_COLOR, uv, blur).rgb *
              material_texel(row, MATERIAL_ROW_F0).rgb;
    lit_material m;
    m.scales = material_texel(row, MATERIAL_ROW_SCALES);
    m.normal_texel = lit_texel(data_textures, row, MATERIAL_NORMAL, uv, blur);
    m.occlusion = lit_texel(data_textures, row, MATERIAL_OCCLUSION, uv, blur).r;
    m.occlusion = mix(1.0, m.occlusion, m.scales.y);
    m.emission = lit_texel(textures, row, MATERIAL_EMISSION, uv, blur).rgb *
                 material_texel(row, MATERIAL_ROW_EMISSION).rgb;
    m.metallic = factors.x * rough.b;
    if (ior > 0.0 && m.scales.w > 0.0)
        specular *= lit_reflectance_in_medium(max(f0.r, max(f0.g, f0.b)), ior);
    m.surface = lit_surface_of(albedo, m.metallic, factors.y * rough.g, f0, specular);
    m.coat = m.coat_roughness = 0.0;
    if (lit_has_coats()) {
        vec4 coat = material_texel(row, MATERIAL_ROW_COAT);
        m.coat = coat.x * lit_texel(data_textures, row, MATERIAL_COAT, uv, blur).r;
        m.coat_roughness =
            coat.y * lit_texel(data_textures, row, MATERIAL_COAT_ROUGHNESS, uv, blur).g;
    }
    return m;
}

/* ---- light ---- */

/* Returns the prefiltered specular environment light from a direction; `lod` is the environment
 * map's mip level for roughness 0. */
vec3 lit_specular(vec3 dir, float roughness, float lod)
{
    if (constant_background == GLOBALS_COLOR)
        return frame.background_color;
    if (constant_background != GLOBALS_ENVIRONMENT)
        return frame.sky_strength * sky_glossy(dir, roughness, frame.sun_dir, frame.sun_strength);
    vec2 at = surroundings_equirect_uv(dir, constant_environment_turn);
    float layer = roughness * float(LIT_ROUGH_LAYERS);
    float first = min(floor(layer), float(LIT_ROUGH_LAYERS - 1));
    vec3 sharper = textureLod(environment_light, vec3(at, max(first - 1.0, 0.0)), 0.0).rgb;
    vec3 blurred = textureLod(environment_light, vec3(at, first), 0.0).rgb;
    if (first == 0.0)
        sharper = textureLod(environment, at, lod).rgb;
    return mix(sharper, blurred, layer - first);
}

/* Returns the radiance from unshadowed punctual lights. `base` is the diffuse base's normal. */
vec3 lit_by_lights_on(lit_surface s, vec3 point, vec3 n, vec3 base, vec3 to_eye)
{
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < constant_scene_lights; i++) {
        vec4 position = texelFetch(lights, ivec2(LIT_LIGHT_POSITION, i), 0);
        vec4 direction = texelFetch(lights, ivec2(LIT_LIGHT_DIRECTION, i), 0);
        vec4 color = texelFetch(lights, ivec2(LIT_LIGHT_COLOR, i), 0);
        vec4 cone = texelFetch(lights, ivec2(LIT_LIGHT_CONE, i), 0);
        sum += lit_by_punctual_light(s, point, n, base, to_eye,
                                     lit_punctual_light(position, direction, color, cone));
    }
    return sum;
}

/* Returns a surface's radiance by punctual lights, for surfaces without a water layer. */
vec3 lit_by_lights(lit_surface s, vec3 point, vec3 n, vec3 to_eye)
{
    return lit_by_lights_on(s, point, n, n, to_eye);
}

/* Returns true if a material shows the environment behind it, with shadows and caustics. */
bool lit_is_shadow_catcher(uint row)
{
    return (constant_textured & CONSTANT_TEXTURED_CATCHER) != 0u &&
           material_texel(row, MATERIAL_ROW_COAT).z > 0.0;
}

/* Returns the albedo at which an unoccluded diffuse surface has this radiance. */
vec3 lit_catcher_albedo(vec3 n, vec3 radiance)
{
    vec3 light = lit_diffuse(n) + sky_sun() * max(dot(n, frame.sun_dir), 0.0);
    return radiance / max(light, 1e-6);
}

/* Returns the split-sum factors of f0 and f90. */
vec2 lit_split(float roughness, float n_dot_v)
{
    vec2 at = lit_split_at(roughness, n_dot_v) + 0.5;
    return textureLod(splits, at / float(LIT_SPLIT_SIDE), 0.0).rg;
}

/* Light that a clear coat reflects. */
struct lit_coat {
    float reflectance; /* fraction that the base does not receive */
    vec3 environment;  /* unweighted specular environment light */
    vec3 direct;       /* reflected light of the sun and of punctual lights */
};

/* Shades a material's clear coat. `n` is the normal without the normal map. `sun` is the sunlight
 * as radiance of a white diffuse surface, and `spread` the minimum width of its lobe. */
lit_coat lit_coat_of(lit_material m, vec3 point, vec3 n, vec3 to_eye, float lod, vec3 sun,
                     float spread)
{
    lit_surface s = lit_coat_surface(m.coat_roughness);
    vec2 split = lit_split(s.roughness, clamp(dot(n, to_eye), 0.0, 1.0));
    lit_coat c;
    c.reflectance = lit_coat_reflectance(m.coat, split);
    c.environment = lit_specular(reflect(-to_eye, n), s.roughness, lod);
    c.direct = m.coat * (sun * lit_by_light(s, n, to_eye, frame.sun_dir, spread) +
                         lit_by_lights(s, point, n, to_eye));
    return c;
}

#if !defined LIT_NO_DERIVATIVES && !defined LIT_PER_VERTEX
/* Returns the environment map's mip level for a mirror reflection, at least `min_lod`. */
float lit_mirror_lod(vec3 dir, float min_lod)
{
    float width = float(textureSize(environment, 0).x);
    float footprint = max(length(dFdx(dir)), length(dFdy(dir))) * width / 6.2831853;
    return max(min_lod, log2(max(footprint, 1e-6)));
}
#endif

#endif
