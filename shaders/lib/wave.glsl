/*
 * wave.glsl: the surface of the water.
 *
 * In pool coordinates: x and y along the water at rest, z up, metres. With r = |(x, y)|, F_i = F /
 * 2^i and phi_i = S t + x y W / F_i the series is
 *     z = -2 V r sum F_i cos phi_i
 * Its slopes grow with r squared; it is meant for r up to about 1.4 units. At r = 0 it has a tip,
 * whose slope is set to 0. The cosine, for comparison with closed forms, is
 *     z = V cos(W x - S t)
 */
#ifndef LIB_WAVE_GLSL
#define LIB_WAVE_GLSL
#include "water.h"

/* Returns the slopes dz/dx and dz/dy in xy and the height in z, in units of the series. */
vec3 wave_series(water_params w, vec2 p, float time)
{
    float r = max(length(p), 1e-6);
    float f = w.amplitude;
    float heights = 0.0; /* sum of F cos phi */
    float sines = 0.0;
    for (uint i = 0u; i < w.octaves; i++) {
        float phi = w.speed * time + p.x * p.y * w.frequency / f;
        heights += f * cos(phi);
        sines += sin(phi);
        f *= 0.5;
    }
    vec2 slopes = 2.0 * w.height * (r * w.frequency * sines * p.yx - heights / r * p);
    return vec3(slopes, -2.0 * w.height * r * heights);
}

vec3 wave_cosine(water_params w, vec2 p, float time)
{
    float phi = w.frequency * p.x - w.speed * time;
    return vec3(-w.height * w.frequency * sin(phi), 0.0, w.height * cos(phi));
}

/* Returns the slopes in xy and the height, metres, in z. */
vec3 wave_at(water_params w, vec2 p, float time)
{
    vec2 q = p / w.scale;
    vec3 wave = w.wave == WATER_SERIES ? wave_series(w, q, time) : wave_cosine(w, q, time);
    return vec3(wave.xy, wave.z * w.scale);
}

/* Returns the unit normal, which points up. */
vec3 wave_normal(vec3 wave)
{
    return normalize(vec3(-wave.xy, 1.0));
}

#endif
