/*
 * brdf.h: BRDF of opaque surfaces, shared by shaders and the CPU reference.
 *
 * GGX microfacets (Trowbridge and Reitz 1975) lie on a diffuse base, as in glTF 2.0, appendix B.
 * Light is given as the radiance of a white diffuse surface. Environment light is prefiltered
 * (Karis 2013, "split sum") and compensated for multiple scattering (Fdez-Aguera 2019).
 */
#ifndef SHADERS_BRDF_H
#define SHADERS_BRDF_H
#include "abi_math.h"

/* Size and layers of the prefiltered environment map, an array of equirectangular images. The last
 * layer is diffuse irradiance. All earlier layers are specular, for roughness 1/7 to 1. */
#define LIT_WIDTH         128
#define LIT_HEIGHT        64
#define LIT_ROUGH_LAYERS  7
#define LIT_DIFFUSE_LAYER 7
#define LIT_LAYERS        8

/* Side of the split-sum BRDF table, texels. A texel holds the weights of f0 and f90. The x axis is
 * the square root of n_dot_v, and the y axis is the roughness. Both go from 0 to 1. */
#define LIT_SPLIT_SIDE 16

#define LIT_COAT_F0      0.04f  /* clear coat's reflectance at normal incidence */
#define LIT_LIGHT_SPREAD 0.001f /* minimum lobe width for punctual lights */
#define LIT_SUN_SPREAD   0.065f /* procedural sun's specular lobe width */

/* Columns of the RGBA32F light texture, one row per light (src/scene/punctual_light.c). */
#define LIT_LIGHT_POSITION  0 /* position, metres; w: 0 if directional */
#define LIT_LIGHT_DIRECTION 1 /* light's unit direction; w: range in metres, 0 if unlimited */
#define LIT_LIGHT_COLOR     2 /* illuminance, lux, or intensity, candela */
#define LIT_LIGHT_CONE      3 /* cosines of a spot light's inner and outer cone angles */
#define LIT_LIGHT_WIDTH     4

struct lit_surface {
    vec3s diffuse;   /* albedo of the diffuse base */
    vec3s f0;        /* reflectance at normal incidence */
    float f90;       /* reflectance at grazing incidence */
    float roughness; /* perceptual; its square is GGX's alpha */
};

/* Converts metallic-roughness parameters with KHR_materials_specular to reflectances. */
ABI_FUNCTION ABI_STRUCT(lit_surface) lit_surface_of(vec3s albedo, float metallic, float roughness,
                                                    vec3s dielectric_f0, float specular)
{
    vec3s one = ABI_VEC3(1.0f, 1.0f, 1.0f);
    ABI_STRUCT(lit_surface) s;
    s.diffuse = glms_vec3_scale(albedo, 1.0f - metallic);
    s.f0 = glms_vec3_lerp(glms_vec3_scale(glms_vec3_minv(dielectric_f0, one), specular), albedo,
                          metallic);
    s.f90 = specular + (1.0f - specular) * metallic;
    s.roughness = roughness;
    return s;
}

/* Returns texel coordinates in the split-sum table, relative to the first texel's centre. `n_dot_v`
 * is the cosine between normal and view direction. */
ABI_FUNCTION vec2s lit_split_at(float roughness, float n_dot_v)
{
    float last = LIT_SPLIT_SIDE - 1.0f;
    return ABI_VEC2(sqrtf(glm_clamp(n_dot_v, 0.0f, 1.0f)) * last,
                    glm_clamp(roughness, 0.0f, 1.0f) * last);
}

/* Factors of prefiltered environment light on a surface. `specular` scales the specular radiance.
 * `diffuse` scales the radiance of a white diffuse surface. */
struct lit_environment_factors {
    vec3s specular, diffuse;
};

/* Returns the factors on environment light. `split` is the surface's split-sum table entry. */
ABI_FUNCTION ABI_STRUCT(lit_environment_factors)
    lit_environment_factors_of(ABI_STRUCT(lit_surface) s, vec2s split)
{
    vec3s one = ABI_VEC3(1.0f, 1.0f, 1.0f);
    vec3s f90 = glms_vec3_scale(one, s.f90);
    float energy_loss = 1.0f - split.x - split.y;
    vec3s single = glms_vec3_add(glms_vec3_scale(s.f0, split.x), glms_vec3_scale(f90, split.y));
    vec3s mean = glms_vec3_lerp(s.f0, f90, 1.0f / 21.0f);
    vec3s mean_loss = glms_vec3_scale(mean, energy_loss);
    vec3s multi = glms_vec3_div(glms_vec3_mul(single, mean_loss), glms_vec3_sub(one, mean_loss));
    float diffuse_fraction = 1.0f - glms_vec3_max(glms_vec3_add(single, multi));
    ABI_STRUCT(lit_environment_factors) factors;
    factors.specular = single;
    factors.diffuse = glms_vec3_add(multi, glms_vec3_scale(s.diffuse, diffuse_fraction));
    return factors;
}

/* Returns a surface's radiance in an environment. `split` is the surface's entry in the split-sum
 * table. `specular` and `diffuse` are the prefiltered environment light. */
ABI_FUNCTION vec3s lit_by_environment(ABI_STRUCT(lit_surface) s, vec2s split, vec3s specular,
                                      vec3s diffuse)
{
    ABI_STRUCT(lit_environment_factors) factors = lit_environment_factors_of(s, split);
    return glms_vec3_add(glms_vec3_mul(factors.specular, specular),
                         glms_vec3_mul(factors.diffuse, diffuse));
}

/* Returns the factor by which a medium changes a surface's Fresnel reflectance, compared with air.
 * `f0` is the reflectance at normal incidence in air. `ior` is the medium's refractive index. */
ABI_FUNCTION float lit_reflectance_in_medium(float f0, float ior)
{
    float root = sqrtf(glm_clamp(f0, 1e-6f, 0.99f));
    float surface_ior = (1.0f + root) / (1.0f - root);
    float in_medium = (surface_ior - ior) / (surface_ior + ior);
    return fminf(in_medium * in_medium / (root * root), 1.0f);
}

/* Returns a clear coat's specular lobe (KHR_materials_clearcoat, refractive index 1.5). It is a
 * surface without a diffuse base. */
ABI_FUNCTION ABI_STRUCT(lit_surface) lit_coat_surface(float roughness)
{
    ABI_STRUCT(lit_surface) s;
    s.diffuse = ABI_VEC3(0.0f, 0.0f, 0.0f);
    s.f0 = ABI_VEC3(LIT_COAT_F0, LIT_COAT_F0, LIT_COAT_F0);
    s.f90 = 1.0f;
    s.roughness = roughness;
    return s;
}

/* Returns a clear coat's directional albedo. The rest of the light reaches the base. `coat` is the
 * coat's factor, and `split` its entry in the split-sum table. */
ABI_FUNCTION float lit_coat_reflectance(float coat, vec2s split)
{
    return coat * (LIT_COAT_F0 * split.x + split.y);
}

/* Returns true if a clear coat reflects more than the base's specular lobe below it. Traced and
 * screen-space reflections replace only the environment light of the stronger lobe. */
ABI_FUNCTION bool lit_coat_is_stronger(float reflectance, vec3s below)
{
    return reflectance > glms_vec3_max(below);
}

/* Returns the radiance that a surface reflects from a light in direction `l`, relative to that of a
 * white diffuse surface facing the light. `n`, `v` (towards the viewer) and `l` are unit. `base` is
 * the normal of the diffuse base, which differs from `n` below a water layer
 * (MATERIAL_IS_WATER_LAYER). GGX's alpha is at least `spread`, half the light's angular radius. */
ABI_FUNCTION vec3s lit_by_light_on(ABI_STRUCT(lit_surface) s, vec3s n, vec3s base, vec3s v, vec3s l,
                                   float spread)
{
    float n_dot_l = glms_vec3_dot(n, l);
    if (n_dot_l <= 0.0f)
        return ABI_VEC3(0.0f, 0.0f, 0.0f);
    float n_dot_v = fmaxf(glms_vec3_dot(n, v), 1e-4f);
    vec3s h = glms_vec3_normalize(glms_vec3_add(v, l));
    float n_dot_h = glms_vec3_dot(n, h);
    float grazing = powf(1.0f - glm_clamp(glms_vec3_dot(v, h), 0.0f, 1.0f), 5.0f);
    float width = fmaxf(s.roughness * s.roughness, spread);
    float square = width * width;
    float d = n_dot_h * n_dot_h * (square - 1.0f) + 1.0f;
    float distribution = square / (d * d); /* GGX normal distribution, times pi */
    float visibility = 0.5f / (n_dot_l * sqrtf(n_dot_v * n_dot_v * (1.0f - square) + square) +
                               n_dot_v * sqrtf(n_dot_l * n_dot_l * (1.0f - square) + square));
    vec3s f90 = ABI_VEC3(s.f90, s.f90, s.f90);
    vec3s fresnel = glms_vec3_lerp(s.f0, f90, grazing);
    vec3s diffuse = glms_vec3_scale(s.diffuse, 1.0f - glms_vec3_max(fresnel));
    vec3s specular = glms_vec3_scale(fresnel, distribution * visibility * n_dot_l);
    return glms_vec3_add(glms_vec3_scale(diffuse, fmaxf(glms_vec3_dot(base, l), 0.0f)), specular);
}

/* Calls lit_by_light_on() with `n` as both normals, for a surface without a water layer. */
ABI_FUNCTION vec3s lit_by_light(ABI_STRUCT(lit_surface) s, vec3s n, vec3s v, vec3s l, float spread)
{
    return lit_by_light_on(s, n, n, v, l, spread);
}

/* Returns a punctual light's attenuation by distance (metres), range and cone, as defined by
 * KHR_lights_punctual. `c` is the cosine between the light's axis and the ray. */
ABI_FUNCTION float lit_attenuation(float distance, float range, float c, vec2s cone)
{
    float near = range > 0.0f ? distance / range : 0.0f;
    float window = glm_clamp(1.0f - near * near * near * near, 0.0f, 1.0f);
    float edge = glm_clamp((c - cone.y) / (cone.x - cone.y), 0.0f, 1.0f);
    return window * edge * edge / fmaxf(distance * distance, 1e-8f);
}

/* Punctual light: a row of the light texture. */
struct lit_punctual_light {
    vec4s position, direction, color, cone;
};

/* Returns the radiance that a surface reflects from an unshadowed punctual light. For `n`, `base`
 * and `v`, see lit_by_light_on(). */
ABI_FUNCTION vec3s lit_by_punctual_light(ABI_STRUCT(lit_surface) s, vec3s point, vec3s n,
                                         vec3s base, vec3s v, ABI_STRUCT(lit_punctual_light) row)
{
    vec3s axis = glms_vec3(row.direction);
    vec3s to_light = row.position.w > 0.0f ? glms_vec3_sub(glms_vec3(row.position), point)
                                           : glms_vec3_negate(axis);
    float distance = glms_vec3_norm(to_light);
    vec3s l = glms_vec3_divs(to_light, fmaxf(distance, 1e-6f));
    float arriving = lit_attenuation(distance, row.direction.w, -glms_vec3_dot(l, axis),
                                     ABI_VEC2(row.cone.x, row.cone.y));
    vec3s light = glms_vec3_divs(glms_vec3_scale(glms_vec3(row.color), arriving), 3.14159265f);
    return glms_vec3_mul(light, lit_by_light_on(s, n, base, v, l, LIT_LIGHT_SPREAD));
}

#endif
