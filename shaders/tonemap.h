/* tonemap.h: shared by tonemap.c and tonemap.frag. */
#ifndef SHADERS_TONEMAP_H
#define SHADERS_TONEMAP_H
#include "abi_math.h"

#define TONEMAP_COLOR 0 /* linear picture */

#define TONEMAP_NEUTRAL 0 /* CONSTANT_TONEMAP_CURVE */
#define TONEMAP_CLIP    1

struct tonemap_push {
    float gain; /* exp2(exposure) */
};

/* Khronos PBR Neutral: base colours up to 0.8 are unchanged, highlights are compressed to white. */
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
    /* new_peak = above / below, and what is left of the colour 1 / (desaturation * (peak -
     * new_peak) + 1): here so that no division waits for another. */
    float below = peak + (room - start);
    float above = below - room * room;
    float scale = above / (peak * (desaturation * (peak * below - above) + below));
    float white = above / below - scale * peak;
    return glms_vec3_add(glms_vec3_scale(c, scale), ABI_VEC3(white, white, white));
}

/*
 * Encodes by IEC 61966-2-1, extended beyond 0 and 1. The power is a polynomial of the fourth root,
 * fitted by Remez' algorithm, with an error of at most 3.5e-5, a hundredth of the step of a byte.
 * On a CPU three powers would take about as long as the rest of this pass.
 */
ABI_FUNCTION float tonemap_srgb(float linear)
{
    float c = glm_clamp(linear, 0.0f, 1.0f);
    float square = sqrtf(c); /* of the fourth root */
    float even = 1.1226816f * square + (0.081329981f * c - 0.064611537f);
    float high = even + sqrtf(square) * (0.19613586f - 0.33550157f * square);
    return c <= 0.0031308f ? c * 12.92f : high;
}

/* Returns the encoded colour, 0 to 1, of linear radiance, as in a PNG file. */
ABI_FUNCTION vec3s tonemap_encode(vec3s radiance, float gain, uint32_t curve)
{
    vec3s c = ABI_VEC3(fmaxf(radiance.x * gain, 0.0f), fmaxf(radiance.y * gain, 0.0f),
                       fmaxf(radiance.z * gain, 0.0f));
    if (curve == TONEMAP_NEUTRAL)
        c = tonemap_neutral(c);
    return ABI_VEC3(tonemap_srgb(c.x), tonemap_srgb(c.y), tonemap_srgb(c.z));
}

#endif
