/*
 * cracks_reflectance.h: reflectance of a crack, a thin parallel air gap, for shaders and C.
 *
 * Thin-film interference by Airy's sum over all internal reflections, at three wavelengths. A gap
 * much thinner than the wavelength reflects nothing, wider ones show interference colours, and
 * beyond 3 micrometres the colours fade into their mean. Beyond the critical angle light tunnels
 * through thin gaps (frustrated total internal reflection).
 *
 * Error: below the critical angle the two polarisations are averaged before the sum, not after it.
 */
#ifndef SHADERS_INCLUSIONS_CRACKS_REFLECTANCE_H
#define SHADERS_INCLUSIONS_CRACKS_REFLECTANCE_H
#include "abi_math.h"

#define CRACKS_FADE_GAP 1.5f /* gap width in micrometres at which colours have faded to 1 / e */

/* Returns a gap's reflectance for cracks_reflectance() at a wavelength given in micrometres. */
ABI_FUNCTION float cracks_reflectance_at(vec3s gap, float phase, float wavelength)
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

/* Returns a gap's reflectance for red, green and blue light (610, 550, 465 nm). `c`: cosine of
 * incidence in the ice; `n`: refractive index, ice / gap; `width`: gap width in micrometres. */
ABI_FUNCTION vec3s cracks_reflectance(float c, float n, float width)
{
    float cosine2 = 1.0f - n * n * (1.0f - c * c); /* squared; negative for total reflection */
    float b = sqrtf(fmaxf(fabsf(cosine2), 1e-8f));
    float across = n * c, along = c / n; /* for s- and p-polarised light */
    float rs = (across - b) / (across + b), rp = (along - b) / (along + b);
    float side = 0.5f * (rs * rs + rp * rp);
    float mean = 2.0f * side / (1.0f + side);
    float s = (across * across + b * b) / (2.0f * across * b + 1e-9f);
    float p = (along * along + b * b) / (2.0f * along * b + 1e-9f);
    float fringes = 4.0f * side / ((1.0f - side) * (1.0f - side) + 1e-9f);
    vec3s gap = ABI_VEC3(cosine2 > 0.0f ? fringes : -1.0f, s * s, p * p);
    float phase = 6.28318531f * width * b;
    vec3s exact =
        ABI_VEC3(cracks_reflectance_at(gap, phase, 0.61f), cracks_reflectance_at(gap, phase, 0.55f),
                 cracks_reflectance_at(gap, phase, 0.465f));
    float coloured =
        cosine2 > 0.0f ? expf(-width * width / (CRACKS_FADE_GAP * CRACKS_FADE_GAP)) : 1.0f;
    return glms_vec3_lerp(ABI_VEC3(mean, mean, mean), exact, coloured);
}

#endif
