/* whitted.c: traces the branches of a ray. */
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
    CROSSINGS_MAX = 4096, /* of a ray that looks for the objects around the eye */
};

/* The light of all branches, and the weight of those that were terminated. */
struct sum {
    vec3s light, remaining;
};

/* ---- the tree ---- */

/* Pushes a branch, or adds its weight to `remaining` if it is terminated. */
static void grow(const struct tracing *tracing, struct branch *stack, uint32_t *count,
                 struct branch branch, struct sum *sum)
{
    const bool is_roulette = tracing->params.roulette;
    const bool is_weak = glms_vec3_max(branch.weight) < tracing->params.cutoff;
    if (branch_is_spent(tracing, &branch) || (is_weak && !is_roulette))
        sum->remaining = glms_vec3_add(sum->remaining, branch.weight);
    else if (!is_roulette || branch_goes_on(tracing, &branch))
        stack[(*count)++] = branch;
}

/* Finds what objects make of the light where a branch has met something around them. Returns false
 * if none is in the way. */
static bool find_sun(const struct tracing *tracing, const struct bvh_hit *hit,
                     const struct branch *b, struct radiance_sun *sun)
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

/* Lets surroundings hide the sun. Returns whether they may. */
static bool hide_sun(const struct tracing *tracing, const struct bvh_hit *hit,
                     const struct branch *b, bool is_found, struct radiance_sun *sun)
{
    const vec3s light = tracing->radiance->globals->sun_light;
    if (!tracing->radiance->hides_sun || !(glms_vec3_max(light) > 0.0f))
        return false;
    if (!is_found)
        *sun = (struct radiance_sun){ .sky = glms_vec3_one(), .own = 1.0f };
    sun->own *= ground_sun(tracing, hit->surface.position, b->seed);
    return true;
}

/* Returns the index, for green, of the medium that a branch is in, relative to that around the
 * objects. */
static float ior_at(const struct tracing *tracing, const struct branch *b)
{
    const uint32_t top = media_top(tracing->media, &b->inside, MEDIA_NOTHING);
    return tracing_medium(tracing, top)->ior[1] /
           tracing_medium(tracing, tracing->media->outside)->ior[1];
}

/* Adds the light of what a branch has met around the objects, or of the sky. Through a blended
 * surface the branch goes on, with the weight that is left; returns whether any is. *ways become
 * branches that bring more light to it. */
static bool meet_surroundings(const struct tracing *tracing, const struct bvh_hit *hit,
                              struct branch *b, struct sum *sum, struct ground_ways *ways)
{
    *ways = (struct ground_ways){ .count = 0 };
    if (!hit) {
        const bool is_open = b->is_gathered || b->scatterings > 0;
        const vec3s sky = is_open ? radiance_open(tracing->radiance, b->ray.dir)
                                  : radiance_sky(tracing->radiance, b->ray.dir);
        sum->light = glms_vec3_muladd(b->weight, sky, sum->light);
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
    const bool is_found = find_sun(tracing, hit, b, &sun);
    if (hide_sun(tracing, hit, b, is_found, &sun) || is_found)
        point.sun = &sun;
    const vec3s light = radiance_surface(tracing->radiance, &point);
    const float passing = radiance_passing(tracing->radiance, &hit->surface);
    *ways = ground_gather(tracing, b, hit, &point, passing);
    sum->light = glms_vec3_sub(sum->light, ways->counted);
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->weight, light), 1.0f - passing, sum->light);
    branch_pass(tracing, b, hit, passing);
    return passing > 0.0f;
}

/* Adds what an object's surface itself shows where it is not wholly transmissive. */
static void add_shine(const struct tracing *tracing, const struct branch *b,
                      const struct meeting *meeting, float fresnel, struct sum *sum)
{
    struct mesh_vertex vertex = meeting->hit.surface;
    if (!(meeting->dress.shine > 0.0f))
        return;
    vertex.normal = meeting->normal;
    const struct radiance_point point = { .vertex = &vertex, .dir = b->ray.dir, .is_base = true };
    const vec3s light = radiance_surface(tracing->radiance, &point);
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->weight, light),
                                   meeting->dress.shine * (1.0f - fresnel), sum->light);
}

/* Traces a branch and its descendants, depth first: one of each two waits on the stack. */
static void follow(const struct tracing *tracing, struct branch first, uint32_t channel,
                   struct sum *sum)
{
    struct branch stack[REFERENCE_BOUNCES_MAX + 1 + GROUND_WAYS];
    uint32_t count = 0;
    grow(tracing, stack, &count, first, sum);
    while (count) {
        struct branch b = stack[--count];
        struct meeting meeting = { .channel = channel };
        const bool is_met = branch_advance(tracing, &b, &meeting);
        sum->light = glms_vec3_add(sum->light, b.air);
        if (!is_met && branch_is_spent(tracing, &b)) {
            sum->remaining = glms_vec3_add(sum->remaining, b.weight);
            continue;
        }
        if (!is_met || meeting.hit.part == BVH_SURROUNDINGS) {
            struct ground_ways ways;
            if (meet_surroundings(tracing, is_met ? &meeting.hit : NULL, &b, sum, &ways))
                grow(tracing, stack, &count, b, sum);
            for (uint32_t i = 0; i < ways.count; i++)
                grow(tracing, stack, &count, ways.ways[i], sum);
            continue;
        }
        const struct fork fork = branch_fork(tracing, &b, &meeting);
        add_shine(tracing, &b, &meeting, fork.parting.fresnel, sum);
        if (b.is_path) {
            grow(tracing, stack, &count, branch_choose(tracing, &b, &fork), sum);
            continue;
        }
        grow(tracing, stack, &count, fork.refracted, sum);
        grow(tracing, stack, &count, fork.reflected, sum);
    }
}

/* ---- layers ---- */

/* Traces the path that is refracted wherever that is possible, from its entry to its first exit. */
static void follow_straight(const struct tracing *tracing, struct branch b,
                            struct reference_seen *seen)
{
    float length = 0.0f;
    b.is_straight = true;
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
        const bool is_total = fork.parting.fresnel >= 1.0f;
        bounces += is_total;
        b = is_total ? fork.reflected : fork.refracted;
    }
    seen->exit = b.ray.dir;
    seen->path = length;
    seen->bounces = (float)bounces;
    seen->met = (float)b.met;
    seen->tir =
        bounces ? 1.0f : 0.0f; /* without total reflection it leaves at the first inner surface */
}

/* Returns the number of the last object that the path meets which is refracted wherever that is
 * possible, from the first surface on; `last` if it meets none. */
static float find_last(const struct tracing *tracing, const struct first *look,
                       const struct fork *fork, float last)
{
    struct branch b = fork->parting.fresnel >= 1.0f ? fork->reflected : fork->refracted;
    struct meeting meeting = { .channel = 1 };
    b.is_straight = true;
    while (b.bounces < tracing->params.bounces && branch_advance(tracing, &b, &meeting)) {
        const struct bvh_hit *hit = &meeting.hit;
        if (hit->part == BVH_SURROUNDINGS) {
            const float passing = radiance_passing(tracing->radiance, &hit->surface);
            if (!(passing > 0.5f))
                return first_number(look, hit);
            branch_pass(tracing, &b, hit, passing);
            continue;
        }
        if (hit->part == BVH_OBJECT)
            last = first_number(look, hit);
        const struct fork next = branch_fork(tracing, &b, &meeting);
        b = next.parting.fresnel >= 1.0f ? next.reflected : next.refracted;
    }
    return last;
}

/* Traces one channel, or all of them if `channels` is 1, 1, 1, from the first surface on. */
static void look_at_object(const struct tracing *tracing, const struct branch *eye,
                           const struct meeting *met, uint32_t channel, vec3s channels,
                           struct reference_seen *seen)
{
    struct meeting meeting = *met;
    meeting.channel = channel;
    const struct fork fork = branch_fork(tracing, eye, &meeting);
    const struct branch *const branches[2] = { &fork.reflected, &fork.refracted };
    const float shares[2] = { fork.parting.fresnel, 1.0f - fork.parting.fresnel };
    vec3s *const seen_light[2] = { &seen->reflection, &seen->refraction };
    struct sum shine = { 0 };
    add_shine(tracing, eye, &meeting, fork.parting.fresnel, &shine);
    seen->color = glms_vec3_muladd(shine.light, channels, seen->color);
    for (int i = 0; i < 2; i++) {
        struct sum sum = { 0 };
        struct branch branch = *branches[i];
        if (!(shares[i] > 0.0f))
            continue;
        branch.weight = glms_vec3_mul(branch.weight, channels);
        follow(tracing, branch, channel, &sum);
        seen->color = glms_vec3_add(seen->color, sum.light);
        seen->remaining = glms_vec3_add(seen->remaining, sum.remaining);
        *seen_light[i] = glms_vec3_muladds(sum.light, 1.0f / shares[i], *seen_light[i]);
    }
}

void whitted_immerse(const struct tracing *tracing, vec3s point, struct media_set *inside)
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

/* Adds all that a branch sees, from the eye in a cloud, or from behind a blended surface. */
static void look_through(const struct tracing *tracing, const struct branch *from,
                         struct reference_seen *seen)
{
    for (uint32_t c = 0; c < tracing_channel_count(tracing); c++) {
        struct branch b = *from;
        struct sum sum = { 0 };
        b.weight = glms_vec3_mul(b.weight, tracing_channels(tracing, c));
        follow(tracing, b, c, &sum);
        seen->color = glms_vec3_add(seen->color, sum.light);
        seen->remaining = glms_vec3_add(seen->remaining, sum.remaining);
    }
}

struct reference_seen whitted_trace(const struct tracing *tracing, const struct bvh_ray *ray,
                                    vec3s forward, uint32_t seed)
{
    struct reference_seen seen = { .alpha = 1.0f, .z = GBUFFER_NOTHING };
    struct branch eye = {
        .ray = *ray,
        .inside = tracing->eye_inside,
        .weight = glms_vec3_one(),
        .seed = seed,
    };
    const bool is_in_cloud = branch_is_in_cloud(tracing, &eye);
    const struct branch first = eye;
    struct meeting meeting = { .channel = 1 };
    eye.is_straight = true;
    const bool is_met = branch_advance(tracing, &eye, &meeting);
    eye.is_straight = false;
    const struct bvh_hit *hit = &meeting.hit;
    const struct first look = { tracing->bvh, tracing->radiance, tracing->earlier };
    if (is_met && tracing->has_layers) {
        first_look(&look, ray, forward, hit, &seen);
    }
    if (!is_met && tracing->radiance->scene->is_hidden) {
        seen.alpha = 0.0f;
        return seen;
    }
    if (is_in_cloud) {
        look_through(tracing, &first, &seen);
        return seen;
    }
    seen.color = eye.air;
    if (!is_met || hit->part == BVH_SURROUNDINGS) {
        struct sum sum = { 0 };
        struct ground_ways ways;
        if (meet_surroundings(tracing, is_met ? hit : NULL, &eye, &sum, &ways))
            look_through(tracing, &eye, &seen);
        for (uint32_t i = 0; i < ways.count; i++)
            look_through(tracing, &ways.ways[i], &seen);
        seen.color = glms_vec3_add(seen.color, sum.light);
        return seen;
    }
    if (tracing->has_layers) {
        const struct fork straight = branch_fork(tracing, &eye, &meeting);
        seen.fresnel = straight.parting.fresnel;
        follow_straight(tracing, straight.refracted, &seen);
        seen.last = find_last(tracing, &look, &straight, seen.last);
    }
    for (uint32_t c = 0; c < tracing_channel_count(tracing); c++)
        look_at_object(tracing, &eye, &meeting, c, tracing_channels(tracing, c), &seen);
    return seen;
}
