/*
 * sky.h: radiance of the procedural sky in a direction, and its light; callers multiply both by
 * globals.sky_strength.
 *
 * It is not based on measurements: a gradient from a bright horizon to a deep zenith, a soft sun,
 * and dark ground below.
 */
#ifndef SHADERS_SKY_H
#define SHADERS_SKY_H
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

ABI_FUNCTION vec3s sky_seen(vec3s dir, vec3s sun_dir, float sun_strength)
{
    float c = glm_clamp(glms_vec3_dot(dir, sun_dir), 0.0f, 1.0f);
    float disc = glm_smoothstep(0.99985f, 0.99995f, c) * 60.0f;
    float glow = 0.9f * powf(c, 400.0f) + 0.25f * powf(c, 24.0f);
    vec3s sun = glms_vec3_scale(SKY_SUN_COLOR, (disc + glow) * sun_strength);
    return glms_vec3_add(sky_gradient(dir), sun);
}

/* Radiance of a disc of an angular radius, where it gives a matt white surface which faces it
 * radiance 1; all of it is in a disc of the radius `blur` if that is larger. Radians. */
ABI_FUNCTION float sky_disc(vec3s dir, vec3s sun_dir, float radius, float blur)
{
    float wide = fmaxf(radius, blur);
    vec3s from_sun = glms_vec3_sub(dir, sun_dir);
    float away = sqrtf(glms_vec3_dot(from_sun, from_sun));
    float edge = fmaxf(0.1f * wide, 0.5f * blur);
    return (1.0f - glm_smoothstep(wide - edge, wide + edge, away)) / (wide * wide);
}

/* Light of the sky on a matt white surface, from above and below. */
ABI_FUNCTION vec3s sky_diffuse(vec3s normal)
{
    vec3s below = ABI_VEC3(0.20f, 0.19f, 0.18f);
    vec3s above = ABI_VEC3(0.42f, 0.50f, 0.62f);
    return glms_vec3_lerp(below, above, 0.5f + 0.5f * normal.y);
}

/* Radiance of the sky in a direction, averaged over what a surface of this roughness reflects
 * there; an estimate. The sun's disc is left out: it is a light of its own. */
ABI_FUNCTION vec3s sky_glossy(vec3s dir, float roughness, vec3s sun_dir, float sun_strength)
{
    float c = glm_clamp(glms_vec3_dot(dir, sun_dir), 0.0f, 1.0f);
    float sharp = (1.0f - roughness) * (1.0f - roughness);
    float glow = 0.9f * powf(c, 400.0f) + 0.25f * powf(c, 24.0f);
    vec3s sun = glms_vec3_scale(SKY_SUN_COLOR, glow * sharp * sun_strength);
    return glms_vec3_add(glms_vec3_lerp(sky_gradient(dir), sky_diffuse(dir), roughness), sun);
}

/* Light reflected by a matt white surface: sun without shadow, and sky from above and below. */
ABI_FUNCTION vec3s sky_reflected(vec3s normal, vec3s sun_dir, float sun_strength)
{
    float sun = fmaxf(0.0f, glms_vec3_dot(normal, sun_dir)) * sun_strength;
    return glms_vec3_add(sky_diffuse(normal), glms_vec3_scale(SKY_SUN_COLOR, sun));
}

#endif
