/* procedural_sky.h: radiance and irradiance of the procedural sky. The sky is a gradient from
 * horizon to zenith, a sun with a soft glow, and dark ground. Callers multiply by
 * globals.sky_strength. */
#ifndef SHADERS_SURROUNDINGS_SKY_H
#define SHADERS_SURROUNDINGS_SKY_H
#include "abi_math.h"

#define SKY_SUN_COLOR ABI_VEC3(1.0f, 0.93f, 0.80f)

ABI_FUNCTION vec3s sky_gradient(vec3s dir)
{
    vec3s horizon = ABI_VEC3(0.72f, 0.80f, 0.90f);
    vec3s zenith = ABI_VEC3(0.09f, 0.24f, 0.62f);
    vec3s ground = ABI_VEC3(0.16f, 0.15f, 0.14f);
    float up = powf(glm_clamp(dir.y, 0.0f, 1.0f), 0.55f);
    float down = glm_smoothstep(0.0f, 0.12f, -dir.y);
    if (dir.y >= 0.0f)
        return glms_vec3_lerp(horizon, zenith, up);
    return glms_vec3_lerp(horizon, ground, down);
}

ABI_FUNCTION vec3s sky_radiance_with_sun(vec3s dir, vec3s sun_dir, float sun_strength)
{
    float c = glm_clamp(glms_vec3_dot(dir, sun_dir), 0.0f, 1.0f);
    float disc = glm_smoothstep(0.99985f, 0.99995f, c) * 60.0f;
    float glow = 0.9f * powf(c, 400.0f) + 0.25f * powf(c, 24.0f);
    vec3s sun = glms_vec3_scale(SKY_SUN_COLOR, (disc + glow) * sun_strength);
    return glms_vec3_add(sky_gradient(dir), sun);
}

/* Returns the radiance of a sun disc. The disc's angular radius is the larger of `radius` and
 * `blur`. A white diffuse surface that faces this sun has radiance 1. */
ABI_FUNCTION float sky_disc(vec3s dir, vec3s sun_dir, float radius, float blur)
{
    float wide = fmaxf(radius, blur);
    vec3s from_sun = glms_vec3_sub(dir, sun_dir);
    float away = sqrtf(glms_vec3_dot(from_sun, from_sun));
    float edge = fmaxf(0.1f * wide, 0.5f * blur);
    return (1.0f - glm_smoothstep(wide - edge, wide + edge, away)) / (wide * wide);
}

/* Returns the irradiance of the sky on a surface, a blend of light from above and from below. */
ABI_FUNCTION vec3s sky_diffuse(vec3s normal)
{
    vec3s below = ABI_VEC3(0.20f, 0.19f, 0.18f);
    vec3s above = ABI_VEC3(0.42f, 0.50f, 0.62f);
    return glms_vec3_lerp(below, above, 0.5f + 0.5f * normal.y);
}

/* Returns the sky's approximate radiance, prefiltered for a reflection of the given roughness. The
 * sun's disc is left out, because it is a separate light source. */
ABI_FUNCTION vec3s sky_glossy(vec3s dir, float roughness, vec3s sun_dir, float sun_strength)
{
    float c = glm_clamp(glms_vec3_dot(dir, sun_dir), 0.0f, 1.0f);
    float sharp = (1.0f - roughness) * (1.0f - roughness);
    float glow = 0.9f * powf(c, 400.0f) + 0.25f * powf(c, 24.0f);
    vec3s sun = glms_vec3_scale(SKY_SUN_COLOR, glow * sharp * sun_strength);
    return glms_vec3_add(glms_vec3_lerp(sky_gradient(dir), sky_diffuse(dir), roughness), sun);
}

/* Returns the light reflected by a white diffuse surface: unshadowed sun plus sky. */
ABI_FUNCTION vec3s sky_reflected(vec3s normal, vec3s sun_dir, float sun_strength)
{
    float sun = fmaxf(0.0f, glms_vec3_dot(normal, sun_dir)) * sun_strength;
    return glms_vec3_add(sky_diffuse(normal), glms_vec3_scale(SKY_SUN_COLOR, sun));
}

#endif
