/* microfacet.c: GGX visible-normal (VNDF) sampling, and Owen-scrambled Sobol points. */
#include "src/lab/reference/microfacet.h"
#include <cglm/struct.h>
#include <math.h>

/* Mixes the bits of x with the finaliser of MurmurHash3 (Appleby 2016). */
static uint32_t mixed(uint32_t x)
{
    x = (x ^ x >> 16) * 0x85ebca6bu;
    x = (x ^ x >> 13) * 0xc2b2ae35u;
    return x ^ x >> 16;
}

uint32_t microfacet_hash(uint32_t a, uint32_t b)
{
    return mixed(a * 0x9e3779b9u + mixed(b + 0x7f4a7c15u));
}

static uint32_t reversed(uint32_t x)
{
    x = (x >> 16) | (x << 16);
    x = (x & 0xff00ff00u) >> 8 | (x & 0x00ff00ffu) << 8;
    x = (x & 0xf0f0f0f0u) >> 4 | (x & 0x0f0f0f0fu) << 4;
    x = (x & 0xccccccccu) >> 2 | (x & 0x33333333u) << 2;
    return (x & 0xaaaaaaaau) >> 1 | (x & 0x55555555u) << 1;
}

/* Owen-scrambles x: a hash of the seed and of all higher bits decides whether a bit is flipped
 * (Burley 2020, section 3, with the constants of Vegdahl 2021). */
static uint32_t scrambled(uint32_t x, uint32_t seed)
{
    x = reversed(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reversed(x);
}

/* Returns the second coordinate of a two-dimensional Sobol point. */
static uint32_t sobol_second(uint32_t index)
{
    uint32_t point = 0;
    for (uint32_t direction = 1u << 31; index; index >>= 1, direction ^= direction >> 1)
        point ^= index & 1 ? direction : 0;
    return point;
}

static float unit(uint32_t x)
{
    return (float)(x >> 8) * 0x1p-24f;
}

vec2s microfacet_point(uint32_t index, uint32_t seed)
{
    const uint32_t shuffled = scrambled(index, mixed(seed));
    return (vec2s){ {
        unit(scrambled(reversed(shuffled), microfacet_hash(seed, 1))),
        unit(scrambled(sobol_second(shuffled), microfacet_hash(seed, 2))),
    } };
}

void microfacet_tangents(vec3s n, vec3s *first, vec3s *second)
{
    const float sign = copysignf(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    *first = (vec3s){ { 1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x } };
    *second = (vec3s){ { b, sign + n.y * n.y * a, -n.y } };
}

vec3s microfacet_sample(vec3s n, vec3s dir, float roughness, vec2s at)
{
    const float alpha = roughness * roughness;
    vec3s x, y;
    microfacet_tangents(n, &x, &y);
    /* View direction in the stretched space, where the distribution of normals is a hemisphere. */
    const vec3s view = glms_vec3_normalize((vec3s){ {
        -alpha * glms_vec3_dot(dir, x),
        -alpha * glms_vec3_dot(dir, y),
        -glms_vec3_dot(dir, n),
    } });
    /* Uniform point of the unit disc. Its second coordinate is warped below to the visible part. */
    const float radius = sqrtf(at.x);
    const float angle = 6.28318531f * at.y;
    const float a = radius * cosf(angle);
    /* Basis vectors of the disc. The visible half of the disc is foreshortened along `up`. */
    const float length = hypotf(view.x, view.y);
    const vec3s right = length > 1e-6f ? (vec3s){ { -view.y / length, view.x / length, 0.0f } }
                                       : (vec3s){ { 1.0f, 0.0f, 0.0f } };
    const vec3s up = glms_vec3_cross(view, right);
    const float s = 0.5f * (1.0f + view.z);
    const float b = (1.0f - s) * sqrtf(fmaxf(1.0f - a * a, 0.0f)) + s * radius * sinf(angle);
    const float c = sqrtf(fmaxf(1.0f - a * a - b * b, 0.0f));
    vec3s h = glms_vec3_scale(right, a);
    h = glms_vec3_muladds(up, b, h);
    h = glms_vec3_muladds(view, c, h);
    h = glms_vec3_normalize((vec3s){ { alpha * h.x, alpha * h.y, fmaxf(h.z, 1e-6f) } });
    vec3s facet = glms_vec3_scale(x, h.x);
    facet = glms_vec3_muladds(y, h.y, facet);
    return glms_vec3_normalize(glms_vec3_muladds(n, h.z, facet));
}

float microfacet_masking(vec3s n, vec3s out, float roughness)
{
    const float alpha = roughness * roughness;
    const float cosine = glms_vec3_dot(n, out);
    const float cos2 = fmaxf(cosine * cosine, 1e-12f);
    const float tan2 = (1.0f - fminf(cos2, 1.0f)) / cos2;
    return 2.0f / (1.0f + sqrtf(1.0f + alpha * alpha * tan2));
}
