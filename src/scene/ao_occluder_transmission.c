/* ao_occluder_transmission.c: Monte Carlo light transport through a convex body. */
#include "src/scene/ao_occluder_transmission.h"
#include <cglm/struct.h>
#include <math.h>

#define UNDEVIATED_COSINE 0.8f /* minimum cosine of "undeviated" deflection */

enum {
    RAYS = 192,        /* number of rays traced through the body */
    RAYS_TRIED = 4096, /* maximum number of rays tried, including rays that miss the body */
    EVENTS_MAX = 24,   /* maximum scattering and reflection events */
};

/* Minimum and maximum start distance of rays from the body's centre, in half diagonals. */
static const float start_min = 0.3f, start_max = 1.6f;

struct ray {
    vec3s at, dir; /* `dir` is unit */
    vec3s weight;
    uint32_t seed;
};

static float random_unit(uint32_t *seed)
{
    *seed = *seed * 747796405u + 2891336453u; /* PCG hash (O'Neill 2014) */
    const uint32_t word = ((*seed >> ((*seed >> 28) + 4)) ^ *seed) * 277803737u;
    return (float)((word >> 22 ^ word) >> 8) * 0x1p-24f;
}

static vec3s random_dir(uint32_t *seed)
{
    const float z = 1.0f - 2.0f * random_unit(seed);
    const float angle = 6.28318531f * random_unit(seed);
    const float r = sqrtf(fmaxf(1.0f - z * z, 0.0f));
    return (vec3s){ { r * cosf(angle), r * sinf(angle), z } };
}

/* Returns the Fresnel reflectance of a dielectric surface. `ratio` is the refractive index in front
 * divided by the index behind. */
static float fresnel(float cosine, float ratio)
{
    const float square = ratio * ratio * (1.0f - cosine * cosine);
    if (square >= 1.0f)
        return 1.0f;
    const float cosine_refracted = sqrtf(1.0f - square);
    const float s = (ratio * cosine - cosine_refracted) / (ratio * cosine + cosine_refracted);
    const float p = (cosine - ratio * cosine_refracted) / (cosine + ratio * cosine_refracted);
    return 0.5f * (s * s + p * p);
}

/* Reflects a ray with the Fresnel reflectance as probability, otherwise refracts it. `n` is the
 * surface normal that faces the ray. Returns true if the ray is refracted. */
static bool reflect_or_refract(struct ray *ray, vec3s n, float ratio)
{
    const float cosine = fminf(-glms_vec3_dot(ray->dir, n), 1.0f);
    if (random_unit(&ray->seed) < fresnel(cosine, ratio)) {
        ray->dir = glms_vec3_muladds(n, 2.0f * cosine, ray->dir);
        return false;
    }
    const float cosine_refracted = sqrtf(1.0f - ratio * ratio * (1.0f - cosine * cosine));
    ray->dir = glms_vec3_normalize(
        glms_vec3_muladds(n, ratio * cosine - cosine_refracted, glms_vec3_scale(ray->dir, ratio)));
    return true;
}

/* Finds where a ray enters and leaves the body. Returns false if the ray misses. */
static bool intersect(const struct ao_shape *shape, const struct ray *ray, float t[2],
                      uint32_t planes[2])
{
    t[0] = -INFINITY;
    t[1] = INFINITY;
    for (uint32_t k = 0; k < AO_PLANES; k++) {
        const vec3s n = glms_vec3(shape->planes[k]);
        const float along = glms_vec3_dot(n, ray->dir);
        const float to = shape->planes[k].w - glms_vec3_dot(n, ray->at);
        if (along < 0.0f && to / along > t[0]) {
            t[0] = to / along;
            planes[0] = k;
        } else if (along > 0.0f && to / along < t[1]) {
            t[1] = to / along;
            planes[1] = k;
        }
    }
    return t[0] < t[1] && t[1] > 0.0f;
}

static void absorb(struct ray *ray, vec3s absorption, float distance)
{
    for (int c = 0; c < 3; c++)
        ray->weight.raw[c] *= expf(-absorption.raw[c] * distance);
}

/* Reflects a ray diffusely, in a cosine-distributed direction around the normal `n`. */
static void scatter_outside(struct ray *ray, vec3s n, vec3s tint)
{
    ray->dir = glms_vec3_normalize(glms_vec3_muladds(n, 1.001f, random_dir(&ray->seed)));
    ray->weight = glms_vec3_mul(ray->weight, tint);
}

/* Traces a ray through the body by a random walk until the ray leaves. */
static void trace_ray(const struct ao_shape *shape, const struct ao_medium *medium, struct ray *ray)
{
    float t[2];
    uint32_t planes[2];
    if (!intersect(shape, ray, t, planes))
        return;
    const vec3s n = glms_vec3(shape->planes[planes[0]]);
    ray->at = glms_vec3_muladds(ray->dir, fmaxf(t[0], 0.0f), ray->at);
    if (random_unit(&ray->seed) < medium->diffuse_fraction) {
        scatter_outside(ray, n, medium->tint);
        return;
    }
    bool is_inside = reflect_or_refract(ray, n, 1.0f / medium->ior);
    if (is_inside)
        ray->weight = glms_vec3_mul(ray->weight, medium->tint);
    for (int i = 0; i < EVENTS_MAX && is_inside; i++) {
        const float free_path =
            -logf(1.0f - random_unit(&ray->seed)) / fmaxf(medium->scattering, 1e-9f);
        if (!intersect(shape, ray, t, planes))
            return;
        absorb(ray, medium->absorption, fminf(free_path, t[1]));
        ray->at = glms_vec3_muladds(ray->dir, fminf(free_path, t[1]), ray->at);
        if (free_path < t[1]) {
            ray->dir = random_dir(&ray->seed);
            continue;
        }
        is_inside = !reflect_or_refract(ray, glms_vec3_negate(glms_vec3(shape->planes[planes[1]])),
                                        medium->ior);
        if (!is_inside)
            ray->weight = glms_vec3_mul(ray->weight, medium->tint);
    }
}

/* Returns a ray from the ground with a cosine-distributed direction. */
static struct ray start_ray(const struct ao_shape *shape, vec3s base, vec3s up, uint32_t number)
{
    struct ray ray = { .weight = glms_vec3_one(), .seed = number * 2654435761u + 1u };
    const float half = 0.5f * box_diagonal(shape->box);
    const vec3s aside = random_dir(&ray.seed);
    const vec3s level =
        glms_vec3_normalize(glms_vec3_muladds(up, -glms_vec3_dot(aside, up), aside));
    const float far = half * (start_min + (start_max - start_min) * random_unit(&ray.seed));
    ray.at = glms_vec3_muladds(level, far, base);
    ray.dir = glms_vec3_normalize(glms_vec3_muladds(up, 1.001f, random_dir(&ray.seed)));
    return ray;
}

/* Returns the point below a bounding box's centre, at the height of the box's lowest corner. */
static vec3s base_of(const struct ao_shape *shape, vec3s up)
{
    const vec3s center = box_center(shape->box);
    float deep = 0.0f;
    for (int axis = 0; axis < 3; axis++)
        deep += fabsf(up.raw[axis]) * (shape->box.max.raw[axis] - center.raw[axis]);
    return glms_vec3_muladds(up, -deep, center);
}

struct ao_light ao_light_of(const struct ao_shape *shape, const struct ao_medium *medium, vec3s up)
{
    struct ao_light light = { .sky = glms_vec3_zero() };
    const vec3s base = base_of(shape, up);
    uint32_t count = 0;
    float undeviated = 0.0f;
    for (uint32_t i = 0; i < RAYS_TRIED && count < RAYS; i++) {
        float t[2];
        uint32_t planes[2];
        struct ray ray = start_ray(shape, base, up, i);
        if (!intersect(shape, &ray, t, planes) || t[0] <= 0.0f)
            continue;
        const vec3s before_body = ray.dir;
        trace_ray(shape, medium, &ray);
        if (glms_vec3_dot(ray.dir, up) > 0.0f &&
            glms_vec3_dot(ray.dir, before_body) > UNDEVIATED_COSINE)
            undeviated += ray.weight.y;
        vec3s *const from = glms_vec3_dot(ray.dir, up) > 0.0f ? &light.sky : &light.ground;
        *from = glms_vec3_add(*from, ray.weight);
        count++;
    }
    light.undeviated = undeviated / fmaxf(light.sky.y, 1e-6f);
    const float scale = 1.0f / (float)(count ? count : 1);
    light.sky = glms_vec3_scale(light.sky, scale);
    light.ground = glms_vec3_scale(light.ground, scale);
    return light;
}
