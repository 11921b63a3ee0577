/* whitted.c: traces the ray tree of a camera ray, and fills its colour and layers. */
#include "src/reference/whitted.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/reference/basin.h"
#include "src/reference/branch.h"
#include "src/reference/first.h"
#include "src/reference/ground.h"
#include "src/reference/photons.h"
#include "src/tech/gbuffer.h"

enum {
    CROSSINGS_MAX = 4096, /* surfaces that the ray from the camera to infinity may cross */
};

/* Radiance summed over all rays of a tree, and the throughput of terminated rays. */
struct sum {
    vec3s light, remaining;
};

/* Pushes a ray onto the stack. A ray that is terminated instead adds its throughput to `remaining`.
 */
static void push(const struct tracer *tracing, struct ray_branch *stack, uint32_t *count,
                 struct ray_branch branch, struct sum *sum)
{
    const bool is_roulette = tracing->params.roulette;
    const bool is_weak = glms_vec3_max(branch.throughput) < tracing->params.cutoff;
    if (branch_is_spent(tracing, &branch) || (is_weak && !is_roulette))
        sum->remaining = glms_vec3_add(sum->remaining, branch.throughput);
    else if (!is_roulette || branch_goes_on(tracing, &branch))
        stack[(*count)++] = branch;
}

/* Computes sunlight and sky light at a surface of the surroundings, as changed by objects and
 * water. Returns false if nothing affects it. */
static bool find_sunlight(const struct tracer *tracing, const struct bvh_hit *hit,
                          const struct ray_branch *b, struct radiance_sun *sun)
{
    const bool is_tile =
        tracing->basin && (hit->surface.material & MESH_TEXTURE_MASK) == MESH_TILES;
    const float side = parting_dot(hit->facet, b->ray.dir) > 0.0 ? -1.0f : 1.0f;
    const vec3s n = glms_vec3_scale(hit->facet, side);
    const vec3s point = hit->surface.position;
    if (tracing->photons)
        *sun = photons_sun_at(tracing, point, n, b->seed);
    else if (is_tile)
        *sun = basin_light(tracing->basin, tracing->radiance->globals, point, n);
    if (is_tile)
        sun->sky = basin_passed(tracing->basin, fmaxf(-point.y, 0.0f));
    return tracing->photons || is_tile;
}

/* Applies shadows of surroundings to direct sunlight. Returns false if they cast none. */
static bool apply_sun_shadow(const struct tracer *tracing, const struct bvh_hit *hit,
                             const struct ray_branch *b, bool is_affected, struct radiance_sun *sun)
{
    const vec3s light = tracing->radiance->globals->sun_light;
    if (!tracing->radiance->hides_sun || !(glms_vec3_max(light) > 0.0f))
        return false;
    if (!is_affected)
        *sun = (struct radiance_sun){ .sky = glms_vec3_one(), .own = 1.0f };
    sun->own *= ground_sun(tracing, hit->surface.position, b->seed);
    return true;
}

/* Returns the index of refraction (green) of the medium around a ray's origin over the outside's.
 */
static float ior_at(const struct tracer *tracing, const struct ray_branch *b)
{
    const uint32_t top = media_top(tracing->media, &b->inside, MEDIA_NOTHING);
    return tracing_medium(tracing, top)->ior[1] /
           tracing_medium(tracing, tracing->media->outside)->ior[1];
}

/* Shades a hit on the surroundings, or the sky if `hit` is NULL; *gather receives rays that add
 * indirect light. Returns true if the ray continues behind a blended surface. */
static bool shade_surroundings(const struct tracer *tracing, const struct bvh_hit *hit,
                               struct ray_branch *b, struct sum *sum, struct light_gather *gather)
{
    *gather = (struct light_gather){ .count = 0 };
    if (!hit) {
        const bool is_open = b->is_gather_ray || b->scatterings > 0;
        const vec3s sky = is_open ? radiance_open(tracing->radiance, b->ray.dir)
                                  : radiance_sky(tracing->radiance, b->ray.dir);
        sum->light = glms_vec3_muladd(b->throughput, sky, sum->light);
        return false;
    }
    struct radiance_point point = {
        .vertex = &hit->surface,
        .extra = &hit->extra,
        .along_u = hit->along_u,
        .along_v = hit->along_v,
        .dir = b->ray.dir,
        .ior = ior_at(tracing, b),
    };
    struct radiance_sun sun;
    const bool is_affected = find_sunlight(tracing, hit, b, &sun);
    if (apply_sun_shadow(tracing, hit, b, is_affected, &sun) || is_affected)
        point.sun = &sun;
    const vec3s light = radiance_surface(tracing->radiance, &point);
    const float passing = radiance_passing(tracing->radiance, &hit->surface);
    *gather = ground_gather(tracing, b, hit, &point, passing);
    sum->light = glms_vec3_sub(sum->light, gather->analytic_sky);
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->throughput, light), 1.0f - passing, sum->light);
    branch_pass(tracing, b, hit, passing);
    return passing > 0.0f;
}

/* Adds the light of an object's opaque base, if its material is not fully transmissive. */
static void add_opaque_base(const struct tracer *tracing, const struct ray_branch *b,
                            const struct meeting *meeting, float fresnel, struct sum *sum)
{
    struct mesh_vertex vertex = meeting->hit.surface;
    if (!(meeting->dress.shine > 0.0f))
        return;
    vertex.normal = meeting->normal;
    const struct radiance_point point = { .vertex = &vertex, .dir = b->ray.dir, .is_base = true };
    const vec3s light = radiance_surface(tracing->radiance, &point);
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->throughput, light),
                                   meeting->dress.shine * (1.0f - fresnel), sum->light);
}

/* Traces a ray and its descendants depth-first, with an explicit stack of pending rays. */
static void trace_tree(const struct tracer *tracing, struct ray_branch first, uint32_t channel,
                       struct sum *sum)
{
    struct ray_branch stack[REFERENCE_BOUNCES_MAX + 1 + GROUND_WAYS];
    uint32_t count = 0;
    push(tracing, stack, &count, first, sum);
    while (count) {
        struct ray_branch b = stack[--count];
        struct meeting meeting = { .channel = channel };
        const bool is_hit = branch_advance(tracing, &b, &meeting);
        sum->light = glms_vec3_add(sum->light, b.air);
        if (!is_hit && branch_is_spent(tracing, &b)) {
            sum->remaining = glms_vec3_add(sum->remaining, b.throughput);
            continue;
        }
        if (!is_hit || meeting.hit.part == BVH_SURROUNDINGS) {
            struct light_gather gather;
            if (shade_surroundings(tracing, is_hit ? &meeting.hit : NULL, &b, sum, &gather))
                push(tracing, stack, &count, b, sum);
            for (uint32_t i = 0; i < gather.count; i++)
                push(tracing, stack, &count, gather.rays[i], sum);
            continue;
        }
        const struct fork fork = branch_fork(tracing, &b, &meeting);
        add_opaque_base(tracing, &b, &meeting, fork.split.fresnel, sum);
        if (b.is_single_path) {
            push(tracing, stack, &count, branch_choose(tracing, &b, &fork), sum);
            continue;
        }
        push(tracing, stack, &count, fork.refracted, sum);
        push(tracing, stack, &count, fork.reflected, sum);
    }
}

/* Follows the path that refracts wherever possible, from its entry to its first exit from all
 * objects, and fills the layers of that path. */
static void fill_refracted_layers(const struct tracer *tracing, struct ray_branch b,
                                  struct reference_seen *seen)
{
    float length = 0.0f;
    b.ignores_scattering = true;
    uint32_t bounces = 0;
    struct meeting meeting = { .channel = 1 };
    while (media_top(tracing->media, &b.inside, MEDIA_NOTHING) != tracing->media->outside &&
           b.bounces < tracing->params.bounces) {
        const vec3s from = b.ray.origin;
        if (!branch_advance(tracing, &b, &meeting))
            break;
        length += glms_vec3_distance(from, meeting.hit.surface.position);
        if (meeting.hit.part == BVH_SURROUNDINGS)
            break;
        const struct fork fork = branch_fork(tracing, &b, &meeting);
        const bool is_total = fork.split.fresnel >= 1.0f;
        bounces += is_total;
        b = is_total ? fork.reflected : fork.refracted;
    }
    seen->exit = b.ray.dir;
    seen->path = length;
    seen->bounces = (float)bounces;
    seen->met = (float)b.met;
    seen->tir =
        /* without total reflection the path exits at the first inner surface */
        bounces ? 1.0f : 0.0f;
}

/* Returns the object number of the last surface of the path that refracts wherever possible, after
 * the first surface; `last` if it hits nothing else. */
static float find_last_object(const struct tracer *tracing,
                              const struct primary_hit_layers *primary, const struct fork *fork,
                              float last)
{
    struct ray_branch b = fork->split.fresnel >= 1.0f ? fork->reflected : fork->refracted;
    struct meeting meeting = { .channel = 1 };
    b.ignores_scattering = true;
    while (b.bounces < tracing->params.bounces && branch_advance(tracing, &b, &meeting)) {
        const struct bvh_hit *hit = &meeting.hit;
        if (hit->part == BVH_SURROUNDINGS) {
            const float passing = radiance_passing(tracing->radiance, &hit->surface);
            if (!(passing > 0.5f))
                return first_number(primary, hit);
            branch_pass(tracing, &b, hit, passing);
            continue;
        }
        if (hit->part == BVH_OBJECT)
            last = first_number(primary, hit);
        const struct fork next = branch_fork(tracing, &b, &meeting);
        b = next.split.fresnel >= 1.0f ? next.reflected : next.refracted;
    }
    return last;
}

/* Traces one colour channel, or all if `channels` is 1, 1, 1, from an object's surface on. */
static void trace_channel(const struct tracer *tracing, const struct ray_branch *camera,
                          const struct meeting *met, uint32_t channel, vec3s channels,
                          struct reference_seen *seen)
{
    struct meeting meeting = *met;
    meeting.channel = channel;
    const struct fork fork = branch_fork(tracing, camera, &meeting);
    const struct ray_branch *const branches[2] = { &fork.reflected, &fork.refracted };
    const float fractions[2] = { fork.split.fresnel, 1.0f - fork.split.fresnel };
    vec3s *const seen_light[2] = { &seen->reflection, &seen->refraction };
    struct sum shine = { 0 };
    add_opaque_base(tracing, camera, &meeting, fork.split.fresnel, &shine);
    seen->color = glms_vec3_muladd(shine.light, channels, seen->color);
    for (int i = 0; i < 2; i++) {
        struct sum sum = { 0 };
        struct ray_branch branch = *branches[i];
        if (!(fractions[i] > 0.0f))
            continue;
        branch.throughput = glms_vec3_mul(branch.throughput, channels);
        trace_tree(tracing, branch, channel, &sum);
        seen->color = glms_vec3_add(seen->color, sum.light);
        seen->remaining = glms_vec3_add(seen->remaining, sum.remaining);
        *seen_light[i] = glms_vec3_muladds(sum.light, 1.0f / fractions[i], *seen_light[i]);
    }
}

void whitted_immerse(const struct tracer *tracing, vec3s point, struct media_set *inside)
{
    struct media_set entered = { 0 };
    struct bvh_hit hit;
    struct bvh_ray ray = { .origin = point,
                           .dir = { { 0.36f, 0.8f, 0.48f } },
                           .from = BVH_NOWHERE };
    *inside = (struct media_set){ 0 };
    for (uint32_t i = 0; i < CROSSINGS_MAX && bvh_meet(tracing->bvh, &ray, &hit); i++) {
        const bool is_entering = parting_dot(hit.facet, ray.dir) < 0.0;
        const bool is_medium = hit.part == BVH_OBJECT || hit.part == BVH_BUBBLES;
        if (is_medium && is_entering)
            media_set_put(&entered, hit.object, true);
        else if (is_medium && !media_set_has(&entered, hit.object))
            media_set_put(inside, hit.object, true);
        else if (is_medium)
            media_set_put(&entered, hit.object, false);
        ray.origin = hit.surface.position;
        ray.near = tracing->bvh->hair;
    }
}

/* Adds all light along a ray; for cameras in a scattering medium, and behind blended surfaces. */
static void trace_all_channels(const struct tracer *tracing, const struct ray_branch *from,
                               struct reference_seen *seen)
{
    for (uint32_t c = 0; c < tracing_channel_count(tracing); c++) {
        struct ray_branch b = *from;
        struct sum sum = { 0 };
        b.throughput = glms_vec3_mul(b.throughput, tracing_channels(tracing, c));
        trace_tree(tracing, b, c, &sum);
        seen->color = glms_vec3_add(seen->color, sum.light);
        seen->remaining = glms_vec3_add(seen->remaining, sum.remaining);
    }
}

struct reference_seen whitted_trace(const struct tracer *tracing, const struct bvh_ray *ray,
                                    vec3s forward, uint32_t seed)
{
    struct reference_seen seen = { .alpha = 1.0f, .z = GBUFFER_NOTHING };
    struct ray_branch camera = {
        .ray = *ray,
        .inside = tracing->eye_inside,
        .throughput = glms_vec3_one(),
        .seed = seed,
    };
    const bool is_in_cloud = branch_is_in_cloud(tracing, &camera);
    const struct ray_branch first = camera;
    struct meeting meeting = { .channel = 1 };
    camera.ignores_scattering = true;
    const bool is_hit = branch_advance(tracing, &camera, &meeting);
    camera.ignores_scattering = false;
    const struct bvh_hit *hit = &meeting.hit;
    const struct primary_hit_layers primary = { tracing->bvh, tracing->radiance, tracing->earlier };
    if (is_hit && tracing->has_layers) {
        first_look(&primary, ray, forward, hit, &seen);
    }
    if (!is_hit && tracing->radiance->scene->is_hidden) {
        seen.alpha = 0.0f;
        return seen;
    }
    if (is_in_cloud) {
        trace_all_channels(tracing, &first, &seen);
        return seen;
    }
    seen.color = camera.air;
    if (!is_hit || hit->part == BVH_SURROUNDINGS) {
        struct sum sum = { 0 };
        struct light_gather gather;
        if (shade_surroundings(tracing, is_hit ? hit : NULL, &camera, &sum, &gather))
            trace_all_channels(tracing, &camera, &seen);
        for (uint32_t i = 0; i < gather.count; i++)
            trace_all_channels(tracing, &gather.rays[i], &seen);
        seen.color = glms_vec3_add(seen.color, sum.light);
        return seen;
    }
    if (tracing->has_layers) {
        const struct fork straight = branch_fork(tracing, &camera, &meeting);
        seen.fresnel = straight.split.fresnel;
        fill_refracted_layers(tracing, straight.refracted, &seen);
        seen.last = find_last_object(tracing, &primary, &straight, seen.last);
    }
    for (uint32_t c = 0; c < tracing_channel_count(tracing); c++)
        trace_channel(tracing, &camera, &meeting, c, tracing_channels(tracing, c), &seen);
    return seen;
}
