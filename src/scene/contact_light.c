/* contact_light.c: follows rays through a convex body. */
#include "src/scene/contact_light.h"
#include <cglm/struct.h>
#include <math.h>

#define STRAIGHT 0.8f /* cosine of the angle by which straight light is turned at most */

enum {
    RAYS = 192,        /* that are followed */
    RAYS_TRIED = 4096, /* at most, to find those that meet the body */
    TURNS = 24,        /* of a ray in the body */
};

/* Where rays start: their distance from the body's middle, horizontally, in halves of its
 * diagonal. */
static const float from_middle = 0.3f, to_middle = 1.6f;

struct ray {
    vec3s at, dir; /* unit */
    vec3s weight;
    uint32_t seed;
};

static float chance(uint32_t *seed)
{
    *seed = *seed * 747796405u + 2891336453u; /* a permuted congruential generator (O'Neill 2014) */
    const uint32_t word = ((*seed >> ((*seed >> 28) + 4)) ^ *seed) * 277803737u;
    return (float)((word >> 22 ^ word) >> 8) * 0x1p-24f;
}

static vec3s any_dir(uint32_t *seed)
{
    const float z = 1.0f - 2.0f * chance(seed);
    const float angle = 6.28318531f * chance(seed);
    const float r = sqrtf(fmaxf(1.0f - z * z, 0.0f));
    return (vec3s){ { r * cosf(angle), r * sinf(angle), z } };
}

/* Returns the share of light that is mirrored; `ratio` is the index before the surface by that
 * behind it (Fresnel's equations). */
static float mirrored(float cosine, float ratio)
{
    const float square = ratio * ratio * (1.0f - cosine * cosine);
    if (square >= 1.0f)
        return 1.0f;
    const float behind = sqrtf(1.0f - square);
    const float s = (ratio * cosine - behind) / (ratio * cosine + behind);
    const float p = (cosine - ratio * behind) / (cosine + ratio * behind);
    return 0.5f * (s * s + p * p);
}

/* Mirrors or bends a ray at a surface whose normal `n` faces it. Returns whether it passes. */
static bool meet(struct ray *ray, vec3s n, float ratio)
{
    const float cosine = fminf(-glms_vec3_dot(ray->dir, n), 1.0f);
    if (chance(&ray->seed) < mirrored(cosine, ratio)) {
        ray->dir = glms_vec3_muladds(n, 2.0f * cosine, ray->dir);
        return false;
    }
    const float behind = sqrtf(1.0f - ratio * ratio * (1.0f - cosine * cosine));
    ray->dir = glms_vec3_normalize(
        glms_vec3_muladds(n, ratio * cosine - behind, glms_vec3_scale(ray->dir, ratio)));
    return true;
}

/* Finds the part of a ray that is in the body: the distances of its ends, and their planes. */
static bool cross(const struct contact_shape *shape, const struct ray *ray, float ends[2],
                  uint32_t planes[2])
{
    ends[0] = -INFINITY;
    ends[1] = INFINITY;
    for (uint32_t k = 0; k < CONTACT_PLANES; k++) {
        const vec3s n = glms_vec3(shape->planes[k]);
        const float along = glms_vec3_dot(n, ray->dir);
        const float to = shape->planes[k].w - glms_vec3_dot(n, ray->at);
        if (along < 0.0f && to / along > ends[0]) {
            ends[0] = to / along;
            planes[0] = k;
        } else if (along > 0.0f && to / along < ends[1]) {
            ends[1] = to / along;
            planes[1] = k;
        }
    }
    return ends[0] < ends[1] && ends[1] > 0.0f;
}

static void absorb(struct ray *ray, vec3s absorption, float way)
{
    for (int c = 0; c < 3; c++)
        ray->weight.raw[c] *= expf(-absorption.raw[c] * way);
}

/* Reflects a ray from the matt part of a surface, to any side but the inner one. */
static void scatter_outside(struct ray *ray, vec3s n, vec3s tint)
{
    ray->dir = glms_vec3_normalize(glms_vec3_muladds(n, 1.001f, any_dir(&ray->seed)));
    ray->weight = glms_vec3_mul(ray->weight, tint);
}

/* Follows a ray through the body until it has left it. */
static void follow(const struct contact_shape *shape, const struct contact_medium *medium,
                   struct ray *ray)
{
    float ends[2];
    uint32_t planes[2];
    if (!cross(shape, ray, ends, planes))
        return;
    const vec3s n = glms_vec3(shape->planes[planes[0]]);
    ray->at = glms_vec3_muladds(ray->dir, fmaxf(ends[0], 0.0f), ray->at);
    if (chance(&ray->seed) < medium->shine) {
        scatter_outside(ray, n, medium->tint);
        return;
    }
    bool is_inside = meet(ray, n, 1.0f / medium->ior);
    if (is_inside)
        ray->weight = glms_vec3_mul(ray->weight, medium->tint);
    for (int i = 0; i < TURNS && is_inside; i++) {
        const float free = -logf(1.0f - chance(&ray->seed)) / fmaxf(medium->scattering, 1e-9f);
        if (!cross(shape, ray, ends, planes))
            return;
        absorb(ray, medium->absorption, fminf(free, ends[1]));
        ray->at = glms_vec3_muladds(ray->dir, fminf(free, ends[1]), ray->at);
        if (free < ends[1]) {
            ray->dir = any_dir(&ray->seed);
            continue;
        }
        is_inside = !meet(ray, glms_vec3_negate(glms_vec3(shape->planes[planes[1]])), medium->ior);
        if (!is_inside)
            ray->weight = glms_vec3_mul(ray->weight, medium->tint);
    }
}

/* Starts a ray on the ground, to as many directions as each lights it. */
static struct ray start(const struct contact_shape *shape, vec3s foot, vec3s up, uint32_t number)
{
    struct ray ray = { .weight = glms_vec3_one(), .seed = number * 2654435761u + 1u };
    const float half = 0.5f * box_diagonal(shape->box);
    const vec3s aside = any_dir(&ray.seed);
    const vec3s level =
        glms_vec3_normalize(glms_vec3_muladds(up, -glms_vec3_dot(aside, up), aside));
    const float far = half * (from_middle + (to_middle - from_middle) * chance(&ray.seed));
    ray.at = glms_vec3_muladds(level, far, foot);
    ray.dir = glms_vec3_normalize(glms_vec3_muladds(up, 1.001f, any_dir(&ray.seed)));
    return ray;
}

/* Returns the point below the middle of a body's box, as deep as that. */
static vec3s foot_of(const struct contact_shape *shape, vec3s up)
{
    const vec3s middle = box_center(shape->box);
    float deep = 0.0f;
    for (int axis = 0; axis < 3; axis++)
        deep += fabsf(up.raw[axis]) * (shape->box.max.raw[axis] - middle.raw[axis]);
    return glms_vec3_muladds(up, -deep, middle);
}

struct contact_light contact_light_of(const struct contact_shape *shape,
                                      const struct contact_medium *medium, vec3s up)
{
    struct contact_light light = { .sky = glms_vec3_zero() };
    const vec3s foot = foot_of(shape, up);
    uint32_t count = 0;
    float straight = 0.0f;
    for (uint32_t i = 0; i < RAYS_TRIED && count < RAYS; i++) {
        float ends[2];
        uint32_t planes[2];
        struct ray ray = start(shape, foot, up, i);
        if (!cross(shape, &ray, ends, planes) || ends[0] <= 0.0f)
            continue;
        const vec3s was = ray.dir;
        follow(shape, medium, &ray);
        if (glms_vec3_dot(ray.dir, up) > 0.0f && glms_vec3_dot(ray.dir, was) > STRAIGHT)
            straight += ray.weight.y;
        vec3s *const from = glms_vec3_dot(ray.dir, up) > 0.0f ? &light.sky : &light.ground;
        *from = glms_vec3_add(*from, ray.weight);
        count++;
    }
    light.straight = straight / fmaxf(light.sky.y, 1e-6f);
    const float each = 1.0f / (float)(count ? count : 1);
    light.sky = glms_vec3_scale(light.sky, each);
    light.ground = glms_vec3_scale(light.ground, each);
    return light;
}
