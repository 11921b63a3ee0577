/* final_gather.c: spawns rays that gather direct and indirect light on the surroundings. */
#include "src/lab/reference/final_gather.h"
#include <cglm/struct.h>
#include "shaders/microfacet.h"

enum {
    TRANSPARENT_MAX = 8, /* transparent surroundings along a shadow ray */
    CROSSINGS_MAX = 4096 /* all surfaces along a shadow ray */
};

/* Minimum throughput of gather rays. Weaker rays are not traced; the sky in their direction counts
 * as unoccluded. The ray-traced refraction model has an equal threshold. */
#define WEIGHT_MIN 1e-3f

static vec2s random_point(const struct tracer *tracing, uint32_t seed, uint32_t salt)
{
    return microfacet_point(tracing->sample, microfacet_hash(seed, salt));
}

static void add_ray(const struct tracer *tracing, const struct ray_branch *b,
                    const struct embree_scene_hit *hit, vec3s dir, vec3s throughput,
                    struct light_gather *gather)
{
    const bool is_below =
        glms_vec3_dot(dir, hit->facet) * glms_vec3_dot(b->ray.dir, hit->facet) >= 0;
    if (is_below || glms_vec3_max(throughput) <= fmaxf(WEIGHT_MIN, tracing->params.cutoff))
        return;
    struct ray_branch ray = *b;
    ray.ray = (struct embree_scene_ray){
        .origin = hit->surface.position,
        .dir = dir,
        .near = tracing->embree_scene->epsilon,
        .from = EMBREE_SCENE_NO_ORIGIN,
    };
    ray.throughput = throughput;
    ray.air = glms_vec3_zero();
    ray.bounces++;
    ray.seed = microfacet_hash(b->seed, DIFFUSE_SAMPLING_PATH_SEED);
    ray.is_gather_ray = true;
    ray.shows_backdrop = false;
    const vec3s sky = radiance_at_infinity(tracing->radiance, dir);
    gather->analytic_sky = glms_vec3_muladd(throughput, sky, gather->analytic_sky);
    gather->rays[gather->count++] = ray;
}

struct light_gather light_gather_at(const struct tracer *tracing, const struct ray_branch *b,
                                    const struct embree_scene_hit *hit,
                                    const struct radiance_point *point, float passing)
{
    struct light_gather gather = { .count = 0 };
    struct radiance_reflectance reflectance;
    if (!tracing->radiance->is_traced || b->is_gather_ray ||
        !radiance_reflectance_at(tracing->radiance, point, &reflectance))
        return gather;
    const vec3s throughput = glms_vec3_scale(b->throughput, 1.0f - passing);
    const vec3s n = reflectance.normal;
    const vec3s diffuse = glms_vec3_scale(glms_vec3_mul(throughput, reflectance.diffuse),
                                          1.0f / DIFFUSE_SAMPLING_RAYS);
    for (uint32_t i = 0; i < DIFFUSE_SAMPLING_RAYS; i++) {
        const vec3s dir = diffuse_sampling_dir(
            n, tracing->guide, i, random_point(tracing, b->seed, DIFFUSE_SAMPLING_SEED + i));
        add_ray(tracing, b, hit, dir,
                glms_vec3_scale(diffuse, diffuse_sampling_weight(n, tracing->guide, dir)), &gather);
    }
    const vec3s h = microfacet_sample(reflectance.top, b->ray.dir, reflectance.roughness,
                                      random_point(tracing, b->seed, DIFFUSE_SAMPLING_GLOSSY_SEED));
    const vec3s reflected = glms_vec3_muladds(h, -2.0f * glms_vec3_dot(h, b->ray.dir), b->ray.dir);
    add_ray(tracing, b, hit, reflected, glms_vec3_mul(throughput, reflectance.glossy), &gather);
    return gather;
}

float light_gather_sun(const struct tracer *tracing, vec3s point, uint32_t seed)
{
    const struct globals *g = tracing->radiance->globals;
    struct embree_scene_hit hit;
    struct embree_scene_ray ray = {
        .origin = point,
        .dir = diffuse_sampling_disc_dir(g->sun_dir, g->sun_radius,
                                         random_point(tracing, seed, DIFFUSE_SAMPLING_SUN_SEED)),
        .near = tracing->embree_scene->epsilon,
        .from = EMBREE_SCENE_NO_ORIGIN,
    };
    float visibility = 1.0f;
    uint32_t transparent_count = 0;
    for (uint32_t i = 0;
         i < CROSSINGS_MAX && visibility > 0.0f && transparent_count < TRANSPARENT_MAX; i++) {
        if (!embree_scene_intersect(tracing->embree_scene, &ray, &hit))
            break;
        if (hit.kind == EMBREE_SCENE_SURROUNDINGS) {
            visibility *= radiance_transmittance(tracing->radiance, &hit.surface);
            transparent_count++;
        }
        ray.origin = hit.surface.position;
    }
    return visibility;
}
