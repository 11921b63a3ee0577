/* whitted.c: traces the ray tree of a camera ray and computes its colour and layers. */
#include "src/lab/reference/whitted.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/lab/reference/final_gather.h"
#include "src/lab/reference/photons.h"
#include "src/lab/reference/pool_scene.h"
#include "src/lab/reference/primary_hit_aovs.h"
#include "src/lab/reference/ray_branch.h"
#include "src/tech/output/gbuffer.h"

enum {
    CROSSINGS_MAX = 4096, /* surfaces between camera and infinity */
};

#define ROUNDING 1e-6f /* relative rounding error of distances */

/* Radiance summed over a ray tree. */
struct sum {
    vec3s light;
    vec3s remaining; /* throughput of terminated rays */
    vec3s backdrop;  /* throughput of rays with shows_backdrop that reach the environment */
};

/* Applies Russian roulette to a ray, with the mean radiance of the surroundings as control variate
 * (Owen, "Monte Carlo theory, methods and examples", 8.9): the sum gets
 * (1 - weight) * throughput * mean radiance, which is negative for a ray that survives. The result
 * is unbiased for any radiance. Returns false if the ray is terminated. */
static bool survives(const struct tracer *tracing, struct ray_branch *branch, struct sum *sum)
{
    const vec3s expected = glms_vec3_mul(branch->throughput, tracing->expected_radiance);
    const float weight = ray_branch_roulette(tracing, branch);
    sum->light = glms_vec3_muladds(expected, 1.0f - weight, sum->light);
    return weight > 0.0f;
}

/* Pushes a ray onto the stack. If the ray is terminated, adds its throughput to `remaining`. The
 * path that gives alpha is exempt from roulette, which would take alpha out of its range. */
static void push(const struct tracer *tracing, struct ray_branch *stack, uint32_t *count,
                 struct ray_branch branch, struct sum *sum)
{
    const bool is_roulette = tracing->params.roulette;
    const bool is_weak = glms_vec3_max(branch.throughput) < tracing->params.cutoff;
    if (ray_branch_is_exhausted(tracing, &branch) || (is_weak && !is_roulette))
        sum->remaining = glms_vec3_add(sum->remaining, branch.throughput);
    else if (!is_roulette || branch.shows_backdrop || survives(tracing, &branch, sum))
        stack[(*count)++] = branch;
}

/* Sets *sun to the sunlight and sky light that reach a hit on the surroundings through objects or
 * water. Returns false if neither affects the light. */
static bool find_sunlight(const struct tracer *tracing, const struct embree_scene_hit *hit,
                          const struct ray_branch *b, struct radiance_sun *sun)
{
    const bool is_tile =
        tracing->pool_scene && (hit->surface.material & MESH_TEXTURE_MASK) == MESH_TILES;
    const float side = dielectric_split_dot(hit->facet, b->ray.dir) > 0.0 ? -1.0f : 1.0f;
    const vec3s n = glms_vec3_scale(hit->facet, side);
    const vec3s point = hit->surface.position;
    if (tracing->photons)
        *sun = photons_sun_at(tracing, point, n, b->seed);
    else if (is_tile)
        *sun = pool_scene_light(tracing->pool_scene, tracing->radiance->globals, point, n);
    if (is_tile)
        sun->sky = pool_scene_transmittance(tracing->pool_scene, fmaxf(-point.y, 0.0f));
    return tracing->photons || is_tile;
}

/* Applies shadows of the surroundings to direct sunlight. Returns false without sun or shadows. */
static bool apply_sun_shadow(const struct tracer *tracing, const struct embree_scene_hit *hit,
                             const struct ray_branch *b, bool is_affected, struct radiance_sun *sun)
{
    const vec3s light = tracing->radiance->globals->sun_light;
    if (!tracing->radiance->hides_sun || !(glms_vec3_max(light) > 0.0f))
        return false;
    if (!is_affected)
        *sun = (struct radiance_sun){ .sky = glms_vec3_one(), .direct = 1.0f };
    sun->direct *= light_gather_sun(tracing, hit->surface.position, b->seed);
    return true;
}

/* Returns the green-channel refractive index at a ray's origin, relative to the outside medium. */
static float ior_at(const struct tracer *tracing, const struct ray_branch *b)
{
    const uint32_t top = nested_media_top(tracing->media, &b->inside, NESTED_MEDIA_NONE);
    return tracer_medium(tracing, top)->ior[1] /
           tracer_medium(tracing, tracing->media->outside)->ior[1];
}

/* Shades a hit on the surroundings, or the sky if `hit` is NULL. Sets *gather to the rays for
 * indirect light. Returns true if the ray continues behind a blended surface. */
static bool shade_surroundings(const struct tracer *tracing, const struct embree_scene_hit *hit,
                               struct ray_branch *b, struct sum *sum, struct light_gather *gather)
{
    *gather = (struct light_gather){ .count = 0 };
    if (!hit && b->shows_backdrop) {
        sum->backdrop = glms_vec3_add(sum->backdrop, b->throughput);
        return false;
    }
    if (!hit) {
        const bool is_open = b->is_gather_ray || b->scatterings > 0;
        const vec3s sky = is_open ? radiance_at_infinity(tracing->radiance, b->ray.dir)
                                  : radiance_sky(tracing->radiance, b->ray.dir);
        sum->light = glms_vec3_muladd(b->throughput, sky, sum->light);
        return false;
    }
    struct radiance_point point = {
        .vertex = &hit->surface,
        .extra = &hit->extra,
        .dp_du = hit->dp_du,
        .dp_dv = hit->dp_dv,
        .dir = b->ray.dir,
        .ior = ior_at(tracing, b),
    };
    struct radiance_sun sun;
    const bool is_affected = find_sunlight(tracing, hit, b, &sun);
    if (apply_sun_shadow(tracing, hit, b, is_affected, &sun) || is_affected)
        point.sun = &sun;
    const vec3s light = radiance_surface(tracing->radiance, &point);
    const float passing = radiance_transmittance(tracing->radiance, &hit->surface);
    *gather = light_gather_at(tracing, b, hit, &point, passing);
    sum->light = glms_vec3_sub(sum->light, gather->analytic_sky);
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->throughput, light), 1.0f - passing, sum->light);
    ray_branch_pass(tracing, b, hit, passing);
    return passing > 0.0f;
}

/* Adds light reflected by an object's opaque base, which fully transmissive materials lack. */
static void add_opaque_base(const struct tracer *tracing, const struct ray_branch *b,
                            const struct surface_hit *surface_hit, float fresnel, struct sum *sum)
{
    struct mesh_vertex vertex = surface_hit->hit.surface;
    if (!(surface_hit->material.opacity > 0.0f))
        return;
    vertex.normal = surface_hit->normal;
    const struct radiance_point point = { .vertex = &vertex, .dir = b->ray.dir, .is_base = true };
    const vec3s light = radiance_surface(tracing->radiance, &point);
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->throughput, light),
                                   surface_hit->material.opacity * (1.0f - fresnel), sum->light);
}

/* Traces a ray and its descendants depth-first, with an explicit stack of pending rays. */
static void trace_tree(const struct tracer *tracing, struct ray_branch first, uint32_t channel,
                       struct sum *sum)
{
    struct ray_branch stack[REFERENCE_BOUNCES_MAX + 1 + LIGHT_GATHER_RAYS];
    uint32_t count = 0;
    push(tracing, stack, &count, first, sum);
    while (count) {
        struct ray_branch b = stack[--count];
        struct surface_hit surface_hit = { .channel = channel };
        const bool is_hit = ray_branch_advance(tracing, &b, &surface_hit);
        sum->light = glms_vec3_add(sum->light, b.air);
        if (!is_hit && ray_branch_is_exhausted(tracing, &b)) {
            sum->remaining = glms_vec3_add(sum->remaining, b.throughput);
            continue;
        }
        if (!is_hit || surface_hit.hit.kind == EMBREE_SCENE_SURROUNDINGS) {
            struct light_gather gather;
            if (shade_surroundings(tracing, is_hit ? &surface_hit.hit : NULL, &b, sum, &gather))
                push(tracing, stack, &count, b, sum);
            for (uint32_t i = 0; i < gather.count; i++)
                push(tracing, stack, &count, gather.rays[i], sum);
            continue;
        }
        const struct fork fork = ray_branch_split(tracing, &b, &surface_hit);
        add_opaque_base(tracing, &b, &surface_hit, fork.split.fresnel, sum);
        if (b.is_single_path) {
            push(tracing, stack, &count, ray_branch_choose(tracing, &b, &fork), sum);
            continue;
        }
        push(tracing, stack, &count, fork.refracted, sum);
        push(tracing, stack, &count, fork.reflected, sum);
    }
}

/* Fills the layers of the refracted path. At each surface the path refracts, or reflects if it
 * must. It ends where it leaves all objects. */
static void fill_refracted_layers(const struct tracer *tracing, struct ray_branch b,
                                  struct reference_ray_values *values)
{
    float length = 0.0f;
    b.ignores_scattering = true;
    uint32_t bounces = 0;
    struct surface_hit surface_hit = { .channel = 1 };
    while (nested_media_top(tracing->media, &b.inside, NESTED_MEDIA_NONE) !=
               tracing->media->outside &&
           b.bounces < tracing->params.bounces) {
        const vec3s from = b.ray.origin;
        if (!ray_branch_advance(tracing, &b, &surface_hit))
            break;
        length += glms_vec3_distance(from, surface_hit.hit.surface.position);
        if (surface_hit.hit.kind == EMBREE_SCENE_SURROUNDINGS)
            break;
        const struct fork fork = ray_branch_split(tracing, &b, &surface_hit);
        const bool is_total = fork.split.fresnel >= 1.0f;
        bounces += is_total;
        b = is_total ? fork.reflected : fork.refracted;
    }
    values->exit = b.ray.dir;
    values->path = length;
    values->bounces = (float)bounces;
    values->inclusion_bits = (float)b.inclusion_bits;
    values->tir = bounces ? 1.0f : 0.0f;
}

/* Returns the object number of the last surface on the refracted path. If there is no surface after
 * the primary hit, returns `last`. */
static float find_last_object(const struct tracer *tracing,
                              const struct primary_hit_layers *primary, const struct fork *fork,
                              float last)
{
    struct ray_branch b = fork->split.fresnel >= 1.0f ? fork->reflected : fork->refracted;
    struct surface_hit surface_hit = { .channel = 1 };
    b.ignores_scattering = true;
    while (b.bounces < tracing->params.bounces && ray_branch_advance(tracing, &b, &surface_hit)) {
        const struct embree_scene_hit *hit = &surface_hit.hit;
        if (hit->kind == EMBREE_SCENE_SURROUNDINGS) {
            const float passing = radiance_transmittance(tracing->radiance, &hit->surface);
            if (!(passing > 0.5f))
                return primary_hit_layers_object(primary, hit);
            ray_branch_pass(tracing, &b, hit, passing);
            continue;
        }
        if (hit->kind == EMBREE_SCENE_OBJECT)
            last = primary_hit_layers_object(primary, hit);
        const struct fork next = ray_branch_split(tracing, &b, &surface_hit);
        b = next.split.fresnel >= 1.0f ? next.reflected : next.refracted;
    }
    return last;
}

/* Subtracts the luminance of the transmitted background from the pixel's alpha. */
static void add_backdrop(vec3s backdrop, struct reference_ray_values *values)
{
    values->alpha -= glms_vec3_dot(backdrop, (vec3s){ { 0.2126f, 0.7152f, 0.0722f } });
}

/* Traces the reflected and refracted ray of a hit. `channels` is 1 in traced colour channels. */
static void trace_channel(const struct tracer *tracing, const struct ray_branch *camera,
                          const struct surface_hit *first_hit, uint32_t channel, vec3s channels,
                          struct reference_ray_values *values)
{
    struct surface_hit surface_hit = *first_hit;
    surface_hit.channel = channel;
    const struct fork fork = ray_branch_split(tracing, camera, &surface_hit);
    const struct ray_branch *const branches[2] = { &fork.reflected, &fork.refracted };
    const float fractions[2] = { fork.split.fresnel, 1.0f - fork.split.fresnel };
    vec3s *const branch_light[2] = { &values->reflection, &values->refraction };
    struct sum base_light = { 0 };
    add_opaque_base(tracing, camera, &surface_hit, fork.split.fresnel, &base_light);
    values->color = glms_vec3_muladd(base_light.light, channels, values->color);
    for (int i = 0; i < 2; i++) {
        struct sum sum = { 0 };
        struct ray_branch branch = *branches[i];
        if (!(fractions[i] > 0.0f))
            continue;
        branch.throughput = glms_vec3_mul(branch.throughput, channels);
        trace_tree(tracing, branch, channel, &sum);
        values->color = glms_vec3_add(values->color, sum.light);
        values->remaining = glms_vec3_add(values->remaining, sum.remaining);
        add_backdrop(sum.backdrop, values);
        *branch_light[i] = glms_vec3_muladds(sum.light, 1.0f / fractions[i], *branch_light[i]);
    }
}

void whitted_find_enclosing(const struct tracer *tracing, vec3s point,
                            struct nested_media_set *inside)
{
    struct nested_media_set entered = { 0 };
    struct embree_scene_hit hit;
    struct embree_scene_search search = { .count = 0 };
    struct embree_scene_ray ray = { .origin = point,
                                    .dir = { { 0.36f, 0.8f, 0.48f } },
                                    .from = EMBREE_SCENE_NO_ORIGIN,
                                    .search = &search };
    *inside = (struct nested_media_set){ 0 };
    for (uint32_t i = 0;
         i < CROSSINGS_MAX && embree_scene_intersect(tracing->embree_scene, &ray, &hit); i++) {
        const bool is_entering = dielectric_split_dot(hit.facet, ray.dir) < 0.0;
        const bool is_medium = hit.kind == EMBREE_SCENE_OBJECT || hit.kind == EMBREE_SCENE_BUBBLES;
        if (is_medium && is_entering)
            nested_media_set_update(&entered, hit.object, true);
        else if (is_medium && !nested_media_set_has(&entered, hit.object))
            nested_media_set_update(inside, hit.object, true);
        else if (is_medium)
            nested_media_set_update(&entered, hit.object, false);
        ray.near = nextafterf(hit.distance, INFINITY);
        if (hit.kind == EMBREE_SCENE_OBJECT) { /* another object may be hit at the same distance */
            embree_scene_search_add(&search, hit.triangle);
            ray.near = hit.distance * (1.0f - ROUNDING);
        }
    }
}

/* Adds the light along a ray to values->color. With dispersion, traces each channel separately. */
static void trace_all_channels(const struct tracer *tracing, const struct ray_branch *from,
                               struct reference_ray_values *values)
{
    for (uint32_t c = 0; c < tracer_channel_count(tracing); c++) {
        struct ray_branch b = *from;
        struct sum sum = { 0 };
        b.throughput = glms_vec3_mul(b.throughput, tracer_channels(tracing, c));
        trace_tree(tracing, b, c, &sum);
        values->color = glms_vec3_add(values->color, sum.light);
        values->remaining = glms_vec3_add(values->remaining, sum.remaining);
        add_backdrop(sum.backdrop, values);
    }
}

struct reference_ray_values whitted_trace(const struct tracer *tracing,
                                          const struct embree_scene_ray *ray, vec3s forward,
                                          uint32_t seed)
{
    struct reference_ray_values values = { .alpha = 1.0f, .z = GBUFFER_NOTHING };
    struct ray_branch camera = {
        .ray = *ray,
        .inside = tracing->camera_inside,
        .throughput = glms_vec3_one(),
        .seed = seed,
        .shows_backdrop = tracing->radiance->scene->background.is_hidden,
    };
    const bool is_in_medium = ray_branch_is_in_scattering(tracing, &camera);
    const struct ray_branch first = camera;
    struct surface_hit surface_hit = { .channel = 1 };
    camera.ignores_scattering = true;
    const bool is_hit = ray_branch_advance(tracing, &camera, &surface_hit);
    camera.ignores_scattering = false;
    const struct embree_scene_hit *hit = &surface_hit.hit;
    const struct primary_hit_layers primary = { tracing->embree_scene, tracing->radiance,
                                                tracing->earlier };
    if (is_hit && tracing->has_layers) {
        primary_hit_layers_fill(&primary, ray, forward, hit, &values);
    }
    const struct scene_background *background = &tracing->radiance->scene->background;
    if (!is_hit && (background->is_hidden || (background->is_backdrop && !is_in_medium))) {
        values.alpha = background->is_hidden ? 0.0f : 1.0f;
        if (!background->is_hidden)
            values.color = background->color;
        return values;
    }
    if (is_in_medium) {
        trace_all_channels(tracing, &first, &values);
        return values;
    }
    values.color = camera.air;
    if (!is_hit || hit->kind == EMBREE_SCENE_SURROUNDINGS) {
        struct sum sum = { 0 };
        struct light_gather gather;
        if (shade_surroundings(tracing, is_hit ? hit : NULL, &camera, &sum, &gather))
            trace_all_channels(tracing, &camera, &values);
        for (uint32_t i = 0; i < gather.count; i++)
            trace_all_channels(tracing, &gather.rays[i], &values);
        values.color = glms_vec3_add(values.color, sum.light);
        return values;
    }
    if (tracing->has_layers) {
        const struct fork primary_split = ray_branch_split(tracing, &camera, &surface_hit);
        values.fresnel = primary_split.split.fresnel;
        fill_refracted_layers(tracing, primary_split.refracted, &values);
        values.last = find_last_object(tracing, &primary, &primary_split, values.last);
    }
    for (uint32_t c = 0; c < tracer_channel_count(tracing); c++)
        trace_channel(tracing, &camera, &surface_hit, c, tracer_channels(tracing, c), &values);
    return values;
}
