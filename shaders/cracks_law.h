/*
 * cracks_law.h: what a crack reflects, a thin gap of air with parallel sides, for shaders and C.
 *
 * Airy's sum of all reflections between the sides, for light of three wavelengths. A gap that is
 * thin against them reflects nothing, wider ones shine in colours, and beyond 3 micrometres those
 * fade into their mean. Beyond the critical angle light tunnels through thin gaps.
 *
 * Error: below the critical angle, polarised light has the reflectance of a side for other light.
 */
#ifndef SHADERS_CRACKS_LAW_H
#define SHADERS_CRACKS_LAW_H
#include "abi_math.h"

#define CRACKS_BLURRED 1.5f /* micrometres: where colours have faded to 1 / e */

/* Returns the reflectance of a gap for light of a wavelength, micrometres; all else is that of
 * cracks_reflectance(). */
ABI_FUNCTION float cracks_at(vec3s gap, float phase, float wavelength)
{
    float x = phase / wavelength;
    float growth = expf(fminf(x, 20.0f));
    float tunnel = 0.5f * (growth - 1.0f / growth);
    float swing = gap.x >= 0.0f ? sinf(x) : tunnel;
    swing *= swing;
    if (gap.x >= 0.0f)
        return gap.x * swing / (1.0f + gap.x * swing);
    return 1.0f - 0.5f / (1.0f + gap.y * swing) - 0.5f / (1.0f + gap.z * swing);
}

/* Returns the reflectance for red, green and blue light (610, 550, 465 nm). `c` is the cosine of
 * the angle to the normal in the ice, `n` its index over that of the gap, `width` the gap's,
 * micrometres. */
ABI_FUNCTION vec3s cracks_reflectance(float c, float n, float width)
{
    float cosine2 = 1.0f - n * n * (1.0f - c * c); /* in the gap; below 0: total reflection */
    float b = sqrtf(fmaxf(fabsf(cosine2), 1e-8f));
    float across = n * c, along = c / n; /* of light polarised across and along */
    float rs = (across - b) / (across + b), rp = (along - b) / (along + b);
    float side = 0.5f * (rs * rs + rp * rp);
    float mean = 2.0f * side / (1.0f + side);
    float s = (across * across + b * b) / (2.0f * across * b + 1e-9f);
    float p = (along * along + b * b) / (2.0f * along * b + 1e-9f);
    float fringes = 4.0f * side / ((1.0f - side) * (1.0f - side) + 1e-9f);
    vec3s gap = ABI_VEC3(cosine2 > 0.0f ? fringes : -1.0f, s * s, p * p);
    float phase = 6.28318531f * width * b;
    vec3s exact = ABI_VEC3(cracks_at(gap, phase, 0.61f), cracks_at(gap, phase, 0.55f),
                           cracks_at(gap, phase, 0.465f));
    float coloured =
        cosine2 > 0.0f ? expf(-width * width / (CRACKS_BLURRED * CRACKS_BLURRED)) : 1.0f;
    return glms_vec3_lerp(ABI_VEC3(mean, mean, mean), exact, coloured);
}

#endif
