/* microfacet.glsl: GGX VNDF sampling and scrambled Sobol points (C:
 * src/lab/reference/microfacet.c). */
#ifndef LIB_MICROFACET_GLSL
#define LIB_MICROFACET_GLSL

uint microfacet_mixed(uint x)
{
    x = (x ^ x >> 16) * 0x85ebca6bu;
    x = (x ^ x >> 13) * 0xc2b2ae35u;
    return x ^ x >> 16;
}

uint microfacet_hash(uint a, uint b)
{
    return microfacet_mixed(a * 0x9e3779b9u + microfacet_mixed(b + 0x7f4a7c15u));
}

uint microfacet_scrambled(uint x, uint seed)
{
    x = bitfieldReverse(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return bitfieldReverse(x);
}

/* Returns a Sobol point's second coordinate; its generator matrix is Pascal's triangle modulo 2. */
uint microfacet_sobol_second(uint index)
{
    uint x = bitfieldReverse(index);
    x ^= (x & 0x55555555u) << 1;
    x ^= (x & 0x33333333u) << 2;
    x ^= (x & 0x0f0f0f0fu) << 4;
    x ^= (x & 0x00ff00ffu) << 8;
    x ^= x << 16;
    return x;
}

float microfacet_unit(uint x)
{
    return float(x >> 8) * (1.0 / 16777216.0);
}

vec2 microfacet_point(uint index, uint seed)
{
    uint shuffled = microfacet_scrambled(index, microfacet_mixed(seed));
    uint x = microfacet_scrambled(bitfieldReverse(shuffled), microfacet_hash(seed, 1u));
    uint y = microfacet_scrambled(microfacet_sobol_second(shuffled), microfacet_hash(seed, 2u));
    return vec2(microfacet_unit(x), microfacet_unit(y));
}

vec3 microfacet_sample(vec3 n, vec3 dir, float roughness, vec2 at)
{
    float alpha = roughness * roughness;
    float handed = n.z < 0.0 ? -1.0 : 1.0;
    float p = -1.0 / (handed + n.z);
    float q = n.x * n.y * p;
    vec3 x = vec3(1.0 + handed * n.x * n.x * p, handed * q, -handed * n.x);
    vec3 y = vec3(q, handed + n.y * n.y * p, -n.y);
    vec3 view = normalize(vec3(-alpha * dot(dir, x), -alpha * dot(dir, y), -dot(dir, n)));
    float radius = sqrt(at.x);
    float angle = 6.28318531 * at.y;
    float a = radius * cos(angle);
    float aside = length(view.xy);
    vec3 right = aside > 1e-6 ? vec3(-view.y, view.x, 0.0) / max(aside, 1e-6) : vec3(1.0, 0.0, 0.0);
    vec3 up = cross(view, right);
    float s = 0.5 * (1.0 + view.z);
    float b = (1.0 - s) * sqrt(max(1.0 - a * a, 0.0)) + s * radius * sin(angle);
    float c = sqrt(max(1.0 - a * a - b * b, 0.0));
    vec3 h = a * right + b * up + c * view;
    h = normalize(vec3(alpha * h.xy, max(h.z, 1e-6)));
    return normalize(h.x * x + h.y * y + h.z * n);
}

float microfacet_masking(vec3 n, vec3 to, float roughness)
{
    float alpha = roughness * roughness;
    float cosine = dot(n, to);
    float cos2 = max(cosine * cosine, 1e-12);
    float tan2 = (1.0 - min(cos2, 1.0)) / cos2;
    return 2.0 / (1.0 + sqrt(1.0 + alpha * alpha * tan2));
}

#endif
