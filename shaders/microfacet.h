/*
 * microfacet.h: sampling of rough dielectric surfaces, one GGX microfacet per pixel sample; shared
 * by shaders and the CPU reference.
 *
 * GGX with alpha = roughness squared, sampled by visible normals (Heitz 2018, Sampling the GGX
 * Distribution of Visible Normals). Light is reflected or refracted at the microfacet (Walter et
 * al. 2007), weighted by the Fresnel reflectance of the macroscopic surface. Single scattering
 * only: shadowed, masked and totally reflected light is lost, which makes rough surfaces too dark.
 * A ball of index 1.5 in a white furnace returns .99, .92 and .64 of the light at roughness .15, .3
 * and .6.
 */
#ifndef SHADERS_MICROFACET_H
#define SHADERS_MICROFACET_H
#include "abi_math.h"

/* Mixes the bits of x with the finaliser of MurmurHash3 (Appleby 2016). */
ABI_FUNCTION uint32_t microfacet_mixed(uint32_t x)
{
    x = (x ^ x >> 16) * 0x85ebca6bu;
    x = (x ^ x >> 13) * 0xc2b2ae35u;
    return x ^ x >> 16;
}

/* Returns a hash of two numbers, to be used as a seed. */
ABI_FUNCTION uint32_t microfacet_hash(uint32_t a, uint32_t b)
{
    return microfacet_mixed(a * 0x9e3779b9u + microfacet_mixed(b + 0x7f4a7c15u));
}

#ifdef GL_core_profile
#define microfacet_reversed bitfieldReverse
#else
ABI_FUNCTION uint32_t microfacet_reversed(uint32_t x)
{
    x = x >> 16 | x << 16;
    x = (x & 0xff00ff00u) >> 8 | (x & 0x00ff00ffu) << 8;
    x = (x & 0xf0f0f0f0u) >> 4 | (x & 0x0f0f0f0fu) << 4;
    x = (x & 0xccccccccu) >> 2 | (x & 0x33333333u) << 2;
    return (x & 0xaaaaaaaau) >> 1 | (x & 0x55555555u) << 1;
}
#endif

/* Owen-scrambles x (Burley 2020, section 3, with Vegdahl's constants of 2021). Whether a bit is
 * flipped depends on a hash of the seed and of all higher bits. */
ABI_FUNCTION uint32_t microfacet_scrambled(uint32_t x, uint32_t seed)
{
    x = microfacet_reversed(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return microfacet_reversed(x);
}

/* Returns a Sobol point's second coordinate; its generator matrix is Pascal's triangle modulo 2. */
ABI_FUNCTION uint32_t microfacet_sobol_second(uint32_t index)
{
    uint32_t x = microfacet_reversed(index);
    x ^= (x & 0x55555555u) << 1;
    x ^= (x & 0x33333333u) << 2;
    x ^= (x & 0x0f0f0f0fu) << 4;
    x ^= (x & 0x00ff00ffu) << 8;
    x ^= x << 16;
    return x;
}

ABI_FUNCTION float microfacet_unit(uint32_t x)
{
    return ABI_FLOAT(x >> 8) * (1.0f / 16777216.0f);
}

/* Returns point `index` of a two-dimensional Sobol sequence with hash-based Owen scrambling (Burley
 * 2020). Sequences with different seeds are independent. */
ABI_FUNCTION vec2s microfacet_point(uint32_t index, uint32_t seed)
{
    uint32_t shuffled = microfacet_scrambled(index, microfacet_mixed(seed));
    uint32_t x = microfacet_scrambled(microfacet_reversed(shuffled), microfacet_hash(seed, 1u));
    uint32_t y = microfacet_scrambled(microfacet_sobol_second(shuffled), microfacet_hash(seed, 2u));
    return ABI_VEC2(microfacet_unit(x), microfacet_unit(y));
}

/* Two unit vectors that form an orthonormal basis with a normal. */
struct microfacet_tangents {
    vec3s x, y;
};

/* Computes tangents without a singularity (Duff et al. 2017). */
ABI_FUNCTION ABI_STRUCT(microfacet_tangents) microfacet_tangents_of(vec3s n)
{
    float handed = n.z < 0.0f ? -1.0f : 1.0f;
    float p = -1.0f / (handed + n.z);
    float q = n.x * n.y * p;
    ABI_STRUCT(microfacet_tangents) tangents;
    tangents.x = ABI_VEC3(1.0f + handed * n.x * n.x * p, handed * q, -handed * n.x);
    tangents.y = ABI_VEC3(q, handed + n.y * n.y * p, -n.y);
    return tangents;
}

/* Returns the vector with coordinates `at` in the orthogonal basis x, y, z. */
ABI_FUNCTION vec3s microfacet_in_basis(vec3s x, vec3s y, vec3s z, vec3s at)
{
    return glms_vec3_add(glms_vec3_add(glms_vec3_scale(x, at.x), glms_vec3_scale(y, at.y)),
                         glms_vec3_scale(z, at.z));
}

/* Samples the normal of a visible microfacet. `dir` is the direction of the incident ray, where
 * dot(dir, n) < 0. `at` is a random point of the unit square. */
ABI_FUNCTION vec3s microfacet_sample(vec3s n, vec3s dir, float roughness, vec2s at)
{
    float alpha = roughness * roughness;
    ABI_STRUCT(microfacet_tangents) t = microfacet_tangents_of(n);
    /* View direction in the stretched space, where the distribution of normals is a hemisphere. */
    vec3s view =
        glms_vec3_normalize(ABI_VEC3(-alpha * glms_vec3_dot(dir, t.x),
                                     -alpha * glms_vec3_dot(dir, t.y), -glms_vec3_dot(dir, n)));
    /* Uniform point of the unit disc. Its second coordinate is warped below to the visible part. */
    float radius = sqrtf(at.x);
    float angle = 6.28318531f * at.y;
    float a = radius * cosf(angle);
    /* Basis vectors of the disc. The visible half of the disc is foreshortened along `up`. */
    float aside = hypotf(view.x, view.y);
    float divisor = fmaxf(aside, 1e-6f);
    vec3s right = aside > 1e-6f ? ABI_VEC3(-view.y / divisor, view.x / divisor, 0.0f)
                                : ABI_VEC3(1.0f, 0.0f, 0.0f);
    vec3s up = glms_vec3_cross(view, right);
    float s = 0.5f * (1.0f + view.z);
    float b = (1.0f - s) * sqrtf(fmaxf(1.0f - a * a, 0.0f)) + s * radius * sinf(angle);
    float c = sqrtf(fmaxf(1.0f - a * a - b * b, 0.0f));
    vec3s h = microfacet_in_basis(right, up, view, ABI_VEC3(a, b, c));
    h = glms_vec3_normalize(ABI_VEC3(alpha * h.x, alpha * h.y, fmaxf(h.z, 1e-6f)));
    return glms_vec3_normalize(microfacet_in_basis(t.x, t.y, n, h));
}

/* Returns the Smith masking factor G1 of GGX, 0 to 1, for light leaving along `to`. */
ABI_FUNCTION float microfacet_masking(vec3s n, vec3s to, float roughness)
{
    float alpha = roughness * roughness;
    float cosine = glms_vec3_dot(n, to);
    float cos2 = fmaxf(cosine * cosine, 1e-12f);
    float tan2 = (1.0f - fminf(cos2, 1.0f)) / cos2;
    return 2.0f / (1.0f + sqrtf(1.0f + alpha * alpha * tan2));
}

#endif
