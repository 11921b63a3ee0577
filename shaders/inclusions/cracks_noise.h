/* cracks_noise.h: rough crack normals from the gradient of noise in three octaves (C and GLSL). */
#ifndef SHADERS_INCLUSIONS_CRACKS_NOISE_H
#define SHADERS_INCLUSIONS_CRACKS_NOISE_H
#include "abi_math.h"

ABI_FUNCTION uint32_t crack_hash(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

ABI_FUNCTION float crack_value(uint32_t x, uint32_t y, uint32_t z)
{
    return ABI_FLOAT(crack_hash(x ^ crack_hash(y ^ crack_hash(z))) >> 8) / 8388607.5f - 1.0f;
}

ABI_FUNCTION float crack_fade(float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

/* Returns the derivative of crack_fade(). */
ABI_FUNCTION float crack_fade_derivative(float t)
{
    return 30.0f * t * t * (t * (t - 2.0f) + 1.0f);
}

/* Returns the gradient of value noise, whose values at integer coordinates are from -1 to 1. */
ABI_FUNCTION vec3s crack_noise_gradient(vec3s p)
{
    vec3s below = ABI_VEC3(floorf(p.x), floorf(p.y), floorf(p.z));
    uint32_t x = ABI_UINT(ABI_INT(below.x));
    uint32_t y = ABI_UINT(ABI_INT(below.y));
    uint32_t z = ABI_UINT(ABI_INT(below.z));
    vec3s t = glms_vec3_sub(p, below);
    vec3s s = ABI_VEC3(crack_fade(t.x), crack_fade(t.y), crack_fade(t.z));
    float across[4]; /* `across`: differences along x */
    float along[4];
    for (uint32_t i = 0u; i < 4u; i++) {
        uint32_t row = y + (i & 1u);
        uint32_t layer = z + (i >> 1);
        float first = crack_value(x, row, layer);
        across[i] = crack_value(x + 1u, row, layer) - first;
        along[i] = first + s.x * across[i];
    }
    float slope_x =
        glm_lerp(glm_lerp(across[0], across[1], s.y), glm_lerp(across[2], across[3], s.y), s.z);
    float slope_y = glm_lerp(along[1] - along[0], along[3] - along[2], s.z);
    float slope_z = glm_lerp(along[2], along[3], s.y) - glm_lerp(along[0], along[1], s.y);
    return ABI_VEC3(crack_fade_derivative(t.x) * slope_x, crack_fade_derivative(t.y) * slope_y,
                    crack_fade_derivative(t.z) * slope_z);
}

ABI_FUNCTION vec3s crack_octave(vec3s p, float frequency, float shift)
{
    return crack_noise_gradient(
        ABI_VEC3(p.x * frequency + shift, p.y * frequency + shift, p.z * frequency + shift));
}

/* Returns normal `n` perturbed by noise of slope `bump`. `p` is in radii of the bounding sphere. */
ABI_FUNCTION vec3s crack_perturbed(vec3s n, vec3s p, float bump)
{
    vec3s slope = glms_vec3_add(glms_vec3_scale(crack_octave(p, 5.0f, 0.0f), 0.6f),
                                glms_vec3_scale(crack_octave(p, 13.0f, 7.3f), 0.3f));
    slope = glms_vec3_add(slope, glms_vec3_scale(crack_octave(p, 31.0f, 3.7f), 0.15f));
    vec3s aside = glms_vec3_sub(slope, glms_vec3_scale(n, glms_vec3_dot(slope, n)));
    return glms_vec3_normalize(glms_vec3_sub(n, glms_vec3_scale(aside, bump)));
}
#endif
