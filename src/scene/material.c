/* material.c: glTF's default material, and the clamping of a material's parameters. */
#include "src/scene/material.h"
#include <cglm/struct.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

struct material material_make(const char *name)
{
    struct material material = {
        .base_color = glms_vec3_one(),
        .roughness = 1.0f,
        .ior = 1.5f,
        .attenuation_color = glms_vec3_one(),
        .alpha = 1.0f,
        .alpha_cutoff = 0.5f,
        .normal_scale = 1.0f,
        .occlusion_strength = 1.0f,
        .specular = 1.0f,
        .specular_color = glms_vec3_one(),
    };
    for (int i = 0; i < MATERIAL_TEXTURE_COUNT; i++) {
        material.textures[i].u_row = (vec3s){ { 1.0f, 0.0f, 0.0f } };
        material.textures[i].v_row = (vec3s){ { 0.0f, 1.0f, 0.0f } };
    }
    snprintf(material.name, sizeof(material.name), "%s", name);
    return material;
}

bool material_is_textured(const struct material *m)
{
    return m->textures[MATERIAL_BASE_COLOR].layer || m->textures[MATERIAL_NORMAL].layer ||
           m->textures[MATERIAL_METALLIC_ROUGHNESS].layer ||
           m->textures[MATERIAL_TRANSMISSION].layer || m->flags & MATERIAL_IS_PARTIAL;
}

static bool clamp(float *value, float min, float max, float initial)
{
    const float value_before = *value;
    *value = isnan(value_before) ? initial : fminf(fmaxf(value_before, min), max);
    return !(value_before == *value);
}

/* Clamps the surface parameters other than the base colour. */
static bool clamp_surface(struct material *m)
{
    const float radiance_max = 65504.0f;
    bool has_changed = false;
    for (int k = 0; k < 3; k++) {
        has_changed |= clamp(&m->emission.raw[k], 0.0f, radiance_max, 0.0f);
        has_changed |= clamp(&m->specular_color.raw[k], 0.0f, radiance_max, 1.0f);
    }
    has_changed |= clamp(&m->metallic, 0.0f, 1.0f, 0.0f);
    has_changed |= clamp(&m->alpha, 0.0f, 1.0f, 1.0f);
    has_changed |= clamp(&m->alpha_cutoff, 0.0f, 1.0f, 0.5f);
    has_changed |= clamp(&m->normal_scale, -radiance_max, radiance_max, 1.0f);
    has_changed |= clamp(&m->occlusion_strength, 0.0f, 1.0f, 1.0f);
    has_changed |= clamp(&m->specular, 0.0f, 1.0f, 1.0f);
    has_changed |= clamp(&m->coat, 0.0f, 1.0f, 0.0f);
    has_changed |= clamp(&m->coat_roughness, 0.0f, 1.0f, 0.0f);
    return has_changed;
}

bool material_clamp(struct material *m)
{
    const float color_max = m->flags & MATERIAL_IS_UNLIT ? 65504.0f : 1.0f;
    bool has_changed = clamp_surface(m);
    if (isinf(m->attenuation_distance)) /* glTF's default; 0 stands for a clear medium */
        m->attenuation_distance = 0.0f;
    for (int k = 0; k < 3; k++) {
        has_changed |= clamp(&m->base_color.raw[k], 0.0f, color_max, 1.0f);
        has_changed |= clamp(&m->attenuation_color.raw[k], 0.0f, 1.0f, 1.0f);
    }
    has_changed |= clamp(&m->roughness, 0.0f, 1.0f, 1.0f);
    has_changed |= clamp(&m->transmission, 0.0f, 1.0f, 0.0f);
    has_changed |= clamp(&m->thickness, 0.0f, 1e6f, 0.0f);
    has_changed |= clamp(&m->ior, 1.0f, 4.0f, 1.5f);
    has_changed |= clamp(&m->dispersion, 0.0f, 10.0f, 0.0f);
    has_changed |= clamp(&m->attenuation_distance, 0.0f, FLT_MAX, 0.0f);
    has_changed |= clamp(&m->scattering_optical_depth, 0.0f, MATERIAL_SCATTERING_MAX, 0.0f);
    return has_changed;
}

vec3s material_absorption(const struct material *m)
{
    const float color_min = 1e-12f; /* limit for black, to avoid log(0) */
    vec3s absorption = glms_vec3_zero();
    for (int k = 0; k < 3 && m->attenuation_distance > 0.0f; k++)
        absorption.raw[k] =
            -logf(fmaxf(m->attenuation_color.raw[k], color_min)) / m->attenuation_distance;
    return absorption;
}
