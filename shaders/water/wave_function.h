/*
 * wave_function.h: height and normal of the water's waves.
 *
 * Pool coordinates: x and y along the water at rest, z up, metres. With r = |(x, y)|, F_i = F / 2^i
 * and phi_i = S t + x y W 2^i the series is
 *     z = -2 V r sum F_i cos phi_i
 * The published phase has W / F_i, where F would act as a frequency, too; both agree for F = 1. The
 * slopes grow with r squared; the series is meant for r up to about 1.4 units. At r = 0 it has a
 * cusp, whose slope is set to 0. The cosine wave, for comparison with closed forms, is
 *     z = V cos(W x - S t)
 */
#ifndef SHADERS_WATER_WAVE_FUNCTION_H
#define SHADERS_WATER_WAVE_FUNCTION_H
#include "abi_math.h"
#include "water/water.h"

/* Returns slopes dz/dx and dz/dy in xy and the height in z. Lengths are in units of w.scale. */
ABI_FUNCTION vec3s wave_series(ABI_STRUCT(water_params) w, vec2s p, float time)
{
    float r = fmaxf(sqrtf(p.x * p.x + p.y * p.y), 1e-6f);
    float f = w.amplitude;
    float phase = p.x * p.y * w.frequency;
    float heights = 0.0f; /* sum of F_i cos phi_i */
    float sines = 0.0f;
    for (uint32_t i = 0u; i < w.octaves; i++) {
        float phi = w.speed * time + phase;
        heights += f * cosf(phi);
        sines += sinf(phi);
        f *= 0.5f;
        phase *= 2.0f;
    }
    float across = r * w.frequency * w.amplitude * sines;
    float along = heights / r;
    float twice = 2.0f * w.height;
    return ABI_VEC3(twice * (across * p.y - along * p.x), twice * (across * p.x - along * p.y),
                    -twice * r * heights);
}

ABI_FUNCTION vec3s wave_cosine(ABI_STRUCT(water_params) w, vec2s p, float time)
{
    float phi = w.frequency * p.x - w.speed * time;
    return ABI_VEC3(-w.height * w.frequency * sinf(phi), 0.0f, w.height * cosf(phi));
}

/* Returns a wave's slopes in xy and its height in metres in z. */
ABI_FUNCTION vec3s wave_at(ABI_STRUCT(water_params) w, vec2s p, float time)
{
    vec2s q = ABI_VEC2(p.x / w.scale, p.y / w.scale);
    vec3s wave = wave_series(w, q, time);
    if (w.wave != WATER_SERIES)
        wave = wave_cosine(w, q, time);
    return ABI_VEC3(wave.x, wave.y, wave.z * w.scale);
}

/* Returns a wave's unit normal, which points up. */
ABI_FUNCTION vec3s wave_normal(vec3s wave)
{
    return glms_vec3_normalize(ABI_VEC3(-wave.x, -wave.y, 1.0f));
}

#endif
