/* ground.c: rays for the light on what is around the objects. */
#include "src/reference/ground.h"
#include <cglm/struct.h>
#include "src/reference/microfacet.h"

enum {
    HOLES_MAX = 8,       /* in the way of the sun */
    CROSSINGS_MAX = 4096 /* of a ray to the sun */
};

/* Branches of less weight are neither traced nor taken away; so are those of the rung trace. */
#define WEIGHT_MIN 1e-3f

static vec2s random_point(const struct tracing *tracing, uint32_t seed, uint32_t own)
{
    return microfacet_point(tracing->sample, microfacet_hash(seed, own));
}

static void put(const struct tracing *tracing, const struct branch *b, const struct bvh_hit *hit,
                vec3s dir, vec3s weight, struct ground_ways *ways)
{
    const bool is_below =
        glms_vec3_dot(dir, hit->facet) * glms_vec3_dot(b->ray.dir, hit->facet) >= 0;
    if (is_below || glms_vec3_max(weight) <= fmaxf(WEIGHT_MIN, tracing->params.cutoff))
        return;
    struct branch way = *b;
    way.ray = (struct bvh_ray){
        .origin = hit->surface.position,
        .dir = dir,
        .near = tracing->bvh->hair,
        .from = BVH_NOWHERE,
    };
    way.weight = weight;
    way.air = glms_vec3_zero();
    way.bounces++;
    way.seed = microfacet_hash(b->seed, GROUND_WAY_SEED);
    way.is_gathered = true;
    const vec3s sky = radiance_open(tracing->radiance, dir);
    ways->counted = glms_vec3_muladd(weight, sky, ways->counted);
    ways->ways[ways->count++] = way;
}

struct ground_ways ground_gather(const struct tracing *tracing, const struct branch *b,
                                 const struct bvh_hit *hit, const struct radiance_point *point,
                                 float passing)
{
    struct ground_ways ways = { .count = 0 };
    struct radiance_shares shares;
    if (!tracing->radiance->is_traced || b->is_gathered ||
        !radiance_shares_at(tracing->radiance, point, &shares))
        return ways;
    const vec3s weight = glms_vec3_scale(b->weight, 1.0f - passing);
    const vec3s n = shares.normal;
    const vec3s matt = glms_vec3_scale(glms_vec3_mul(weight, shares.matt), 1.0f / GROUND_MATT_WAYS);
    for (uint32_t i = 0; i < GROUND_MATT_WAYS; i++) {
        const vec3s dir =
            ground_dir(n, tracing->guide, i, random_point(tracing, b->seed, GROUND_MATT_SEED + i));
        put(tracing, b, hit, dir, glms_vec3_scale(matt, ground_weight(n, tracing->guide, dir)),
            &ways);
    }
    const vec3s h = microfacet_sample(shares.top, b->ray.dir, shares.roughness,
                                      random_point(tracing, b->seed, GROUND_GLOSSY_SEED));
    const vec3s mirrored = glms_vec3_muladds(h, -2.0f * glms_vec3_dot(h, b->ray.dir), b->ray.dir);
    put(tracing, b, hit, mirrored, glms_vec3_mul(weight, shares.glossy), &ways);
    return ways;
}

float ground_sun(const struct tracing *tracing, vec3s point, uint32_t seed)
{
    const struct globals *g = tracing->radiance->globals;
    struct bvh_hit hit;
    struct bvh_ray ray = {
        .origin = point,
        .dir = ground_disc_dir(g->sun_dir, g->sun_radius,
                               random_point(tracing, seed, GROUND_SUN_SEED)),
        .near = tracing->bvh->hair,
        .from = BVH_NOWHERE,
    };
    float passing = 1.0f;
    uint32_t holes = 0;
    for (uint32_t i = 0; i < CROSSINGS_MAX && passing > 0.0f && holes < HOLES_MAX; i++) {
        if (!bvh_meet(tracing->bvh, &ray, &hit))
            break;
        if (hit.part == BVH_SURROUNDINGS) {
            passing *= radiance_passing(tracing->radiance, &hit.surface);
            holes++;
        }
        ray.origin = hit.surface.position;
    }
    return passing;
}
