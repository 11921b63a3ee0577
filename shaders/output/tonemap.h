/* tonemap.h: tone mapping curves and sRGB encoding, for tonemap.frag and C. */
#ifndef SHADERS_OUTPUT_TONEMAP_H
#define SHADERS_OUTPUT_TONEMAP_H
#include "abi_math.h"

#define TONEMAP_COLOR 0 /* linear HDR image */

#define TONEMAP_NEUTRAL 0 /* values of CONSTANT_TONEMAP_CURVE */
#define TONEMAP_CLIP    1
#define TONEMAP_AGX     2
#define TONEMAP_ACES    3
#define TONEMAP_HABLE   4
#define TONEMAP_LAST    TONEMAP_HABLE

/* Parameters of tone mapping, shared by tonemap.frag and all callers in C. The result of tone
 * mapping must not depend on anything else. */
struct tonemap_params {
    float gain;     /* exp2(exposure) */
    uint32_t curve; /* TONEMAP_NEUTRAL, ... */
};

/* Applies Khronos PBR Neutral. Base colours up to 0.8 are unchanged; highlights fade to white. */
ABI_FUNCTION vec3s tonemap_neutral(vec3s c)
{
    float start = 0.8f - 0.04f;
    float desaturation = 0.15f;
    float range = 1.0f - start;
    float low = fminf(c.x, fminf(c.y, c.z));
    float offset = low < 0.08f ? low - 6.25f * low * low : 0.04f;
    c = ABI_VEC3(c.x - offset, c.y - offset, c.z - offset);
    float peak = fmaxf(c.x, fmaxf(c.y, c.z));
    if (peak < start)
        return c;
    /* The two divisions are independent of each other. In the published form, the second one waits:
     * new_peak = above / below, then 1 / (desaturation * (peak - new_peak) + 1). */
    float below = peak + (range - start);
    float above = below - range * range;
    float scale = above / (peak * (desaturation * (peak * below - above) + below));
    float white = above / below - scale * peak;
    return glms_vec3_add(glms_vec3_scale(c, scale), ABI_VEC3(white, white, white));
}

/* Applies the AgX curve (Sobotka 2022, Wrensch 2023) to a channel. The result has gamma 2.2. */
ABI_FUNCTION float tonemap_agx_channel(float c)
{
    float min_ev = -12.47393f, max_ev = 4.026069f;
    float v = (glm_clamp(log2f(fmaxf(c, 1e-10f)), min_ev, max_ev) - min_ev) / (max_ev - min_ev);
    float high = ((15.5f * v - 40.14f) * v + 31.96f) * v - 6.868f;
    return ((high * v + 0.4298f) * v + 0.1191f) * v - 0.00232f;
}

ABI_FUNCTION vec3s tonemap_agx(vec3s c)
{
    vec3s v =
        ABI_VEC3(tonemap_agx_channel(glms_vec3_dot(
                     c, ABI_VEC3(0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f))),
                 tonemap_agx_channel(glms_vec3_dot(
                     c, ABI_VEC3(0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f))),
                 tonemap_agx_channel(glms_vec3_dot(
                     c, ABI_VEC3(0.0423756549057051f, 0.0784336f, 0.879142973793104f))));
    float r =
        glms_vec3_dot(v, ABI_VEC3(1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f));
    float g =
        glms_vec3_dot(v, ABI_VEC3(-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f));
    float b =
        glms_vec3_dot(v, ABI_VEC3(-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f));
    return ABI_VEC3(powf(fmaxf(r, 0.0f), 2.2f), powf(fmaxf(g, 0.0f), 2.2f),
                    powf(fmaxf(b, 0.0f), 2.2f));
}

/* Applies the ACES curve (reference rendering and output transforms, Hill 2016) to a channel. */
ABI_FUNCTION float tonemap_aces_channel(float v)
{
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.432951f) + 0.238081f);
}

ABI_FUNCTION vec3s tonemap_aces(vec3s c)
{
    vec3s v =
        ABI_VEC3(tonemap_aces_channel(glms_vec3_dot(c, ABI_VEC3(0.59719f, 0.35458f, 0.04823f))),
                 tonemap_aces_channel(glms_vec3_dot(c, ABI_VEC3(0.07600f, 0.90834f, 0.01566f))),
                 tonemap_aces_channel(glms_vec3_dot(c, ABI_VEC3(0.02840f, 0.13383f, 0.83777f))));
    return ABI_VEC3(glms_vec3_dot(v, ABI_VEC3(1.60475f, -0.53108f, -0.07367f)),
                    glms_vec3_dot(v, ABI_VEC3(-0.10208f, 1.10813f, -0.00605f)),
                    glms_vec3_dot(v, ABI_VEC3(-0.00327f, -0.07276f, 1.07602f)));
}

/* Applies Hable's filmic curve (2010) to a channel. tonemap_hable() scales white, 11.2, to 1. */
ABI_FUNCTION float tonemap_hable_channel(float x)
{
    return (x * (0.15f * x + 0.05f) + 0.004f) / (x * (0.15f * x + 0.5f) + 0.06f) - 0.02f / 0.3f;
}

ABI_FUNCTION vec3s tonemap_hable(vec3s c)
{
    vec3s v = ABI_VEC3(tonemap_hable_channel(2.0f * c.x), tonemap_hable_channel(2.0f * c.y),
                       tonemap_hable_channel(2.0f * c.z));
    return glms_vec3_scale(v, 1.0f / tonemap_hable_channel(11.2f));
}

/* Encodes by the sRGB transfer function of IEC 61966-2-1; the argument is clamped to 0 to 1. The
 * power function is approximated by a polynomial in the fourth root (Remez algorithm), with an
 * error of at most 3.5e-5, a hundredth of an 8-bit step. On a CPU three calls of pow() would take
 * about as long as the rest of this pass. */
ABI_FUNCTION float tonemap_srgb(float linear)
{
    float c = glm_clamp(linear, 0.0f, 1.0f);
    float square = sqrtf(c); /* square of the fourth root */
    float even = 1.1226816f * square + (0.081329981f * c - 0.064611537f);
    float high = even + sqrtf(square) * (0.19613586f - 0.33550157f * square);
    return c <= 0.0031308f ? c * 12.92f : high;
}

/* Returns the tone-mapped colour of linear radiance, before clamping and encoding. */
ABI_FUNCTION vec3s tonemap_apply(vec3s radiance, ABI_STRUCT(tonemap_params) params)
{
    vec3s c = ABI_VEC3(fmaxf(radiance.x * params.gain, 0.0f), fmaxf(radiance.y * params.gain, 0.0f),
                       fmaxf(radiance.z * params.gain, 0.0f));
    if (params.curve == TONEMAP_NEUTRAL)
        c = tonemap_neutral(c);
    else if (params.curve == TONEMAP_AGX)
        c = tonemap_agx(c);
    else if (params.curve == TONEMAP_ACES)
        c = tonemap_aces(c);
    else if (params.curve == TONEMAP_HABLE)
        c = tonemap_hable(c);
    return c;
}

/* Returns linear radiance after tone mapping and sRGB encoding, each channel from 0 to 1. */
ABI_FUNCTION vec3s tonemap_encode(vec3s radiance, ABI_STRUCT(tonemap_params) params)
{
    vec3s c = tonemap_apply(radiance, params);
    return ABI_VEC3(tonemap_srgb(c.x), tonemap_srgb(c.y), tonemap_srgb(c.z));
}

#endif
