/* tonemap.h: what tonemap.c and tonemap.frag agree on. */
#ifndef SHADERS_TONEMAP_H
#define SHADERS_TONEMAP_H
#include "abi_math.h"

#define TONEMAP_COLOR 0 /* linear picture */

#define TONEMAP_NEUTRAL 0 /* CONSTANT_TONEMAP_CURVE */
#define TONEMAP_CLIP    1

struct tonemap_push {
    float gain; /* exp2(exposure) */
};

/* Khronos PBR Neutral: base colours up to 0.8 as they are, highlights compressed to white. */
ABI_FUNCTION vec3s tonemap_neutral(vec3s c)
{
    float start = 0.8f - 0.04f;
    float desaturation = 0.15f;
    float room = 1.0f - start;
    float low = fminf(c.x, fminf(c.y, c.z));
    float offset = low < 0.08f ? low - 6.25f * low * low : 0.04f;
    c = ABI_VEC3(c.x - offset, c.y - offset, c.z - offset);
    float peak = fmaxf(c.x, fmaxf(c.y, c.z));
    if (peak < start)
        return c;
    float new_peak = 1.0f - room * room / (peak + room - start);
    float g = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
    return glms_vec3_lerp(glms_vec3_scale(c, new_peak / peak),
                          ABI_VEC3(new_peak, new_peak, new_peak), g);
}

/*
 * IEC 61966-2-1, of what lies beyond 0 and 1 too. The power is a polynomial of the fourth root, by
 * Remez' algorithm: wrong by 3.5e-5 at most, a hundredth of a byte's step. Three powers take a CPU
 * about as long as all the rest of this pass.
 */
ABI_FUNCTION float tonemap_srgb(float linear)
{
    float c = glm_clamp(linear, 0.0f, 1.0f);
    float s = sqrtf(sqrtf(c));
    float high = 1.1226816f + s * (s * 0.081329981f - 0.33550157f);
    high = s * (0.19613586f + s * high) - 0.064611537f;
    return c <= 0.0031308f ? c * 12.92f : high;
}

/* What a PNG file shows of linear radiance, 0 to 1. */
ABI_FUNCTION vec3s tonemap_encode(vec3s radiance, float gain, uint32_t curve)
{
    vec3s c = ABI_VEC3(fmaxf(radiance.x * gain, 0.0f), fmaxf(radiance.y * gain, 0.0f),
                       fmaxf(radiance.z * gain, 0.0f));
    if (curve == TONEMAP_NEUTRAL)
        c = tonemap_neutral(c);
    return ABI_VEC3(tonemap_srgb(c.x), tonemap_srgb(c.y), tonemap_srgb(c.z));
}

#endif
