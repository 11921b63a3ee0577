/*
 * whitted.c: traces the branches of a ray.
 *
 * Fresnel's equations for unpolarised light (Born and Wolf, Principles of Optics, 1.5.2), Snell's
 * law, and the law of Beer and Lambert on paths inside. Differences of nearly equal numbers are
 * computed in double.
 */
#include "src/reference/whitted.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/bump_normal.h"
#include "src/reference/microfacet.h"
#include "src/tech/gbuffer.h"

/* Reflection and refraction at an object's surface. */
struct parting {
    float fresnel; /* reflectance; 1: total reflection */
    vec3s reflected, refracted;
    float reflected_share, refracted_share; /* of the light in these directions: what a rough
                                               surface does not mask */
};

struct branch {
    struct bvh_ray ray;
    struct media_set inside; /* the objects that the ray is in */
    vec3s weight;
    vec3s air;        /* light that planes of air have added since its last surface */
    uint32_t bounces; /* surfaces that it has met */
    uint32_t seed;    /* of the random numbers at its next surface */
};

/* A ray's meeting with an object. */
struct meeting {
    struct bvh_hit hit;
    struct media_crossing crossing;
    uint32_t channel; /* colour of the light, for dispersion */
    uint32_t seed;
};

enum {
    CROSSINGS_MAX = 4096, /* of a ray that looks for the objects around the eye */
    FROST_SEED = 3,       /* what a seed is hashed with for a random number of its own */
};

/* Rougher surfaces are not smooth. */
#define ROUGHNESS_MIN 1e-3f

/* The light of all branches, and the weight of those that were terminated. */
struct sum {
    vec3s light, remaining;
};

/* ---- at the surface ---- */

static double dot(vec3s a, vec3s b)
{
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Returns a d + b n, normalised. */
static vec3s combined(double a, vec3s d, double b, vec3s n)
{
    double v[3];
    double length2 = 0.0;
    for (int k = 0; k < 3; k++) {
        v[k] = a * (double)d.raw[k] + b * (double)n.raw[k];
        length2 += v[k] * v[k];
    }
    const double scale = 1.0 / sqrt(length2);
    return (vec3s){ { (float)(v[0] * scale), (float)(v[1] * scale), (float)(v[2] * scale) } };
}

/* Computes both directions and the reflectance. `n` faces the incident side; `eta` is the index of
 * the incident side over that of the other. */
static struct parting part_at(vec3s d, vec3s n, double eta)
{
    const double ci = fmin(-dot(d, n), 1.0);
    const double sin2 = eta * eta * (1.0 - ci * ci);
    struct parting parting = {
        .fresnel = 1.0f,
        .reflected = combined(1.0, d, 2.0 * ci, n),
        .reflected_share = 1.0f,
        .refracted_share = 1.0f,
    };
    if (sin2 >= 1.0)
        return parting;
    const double ct = sqrt(1.0 - sin2);
    const double rs = (eta * ci - ct) / (eta * ci + ct);
    const double rp = (ci - eta * ct) / (ci + eta * ct);
    parting.fresnel = (float)(0.5 * (rs * rs + rp * rp));
    parting.refracted = combined(eta, d, eta * ci - ct, n);
    return parting;
}

/* A wall so thin that light leaves it where it has entered, after reflections inside of it. */
static struct parting part_thin(vec3s d, vec3s n, double eta)
{
    struct parting parting = part_at(d, n, eta);
    parting.fresnel = 2.0f * parting.fresnel / (1.0f + parting.fresnel);
    parting.refracted = d;
    return parting;
}

static const struct frame_medium *medium(const struct whitted *whitted, uint32_t index)
{
    return &whitted->media->all[index];
}

/* Parts light at a crack: a gap too thin to displace it, but wider than a wavelength. */
static struct parting part_gap(const struct whitted *whitted, vec3s dir,
                               const struct meeting *meeting)
{
    const struct bvh_hit *hit = &meeting->hit;
    const double eta = (double)medium(whitted, hit->object)->ior[meeting->channel] /
                       (double)medium(whitted, whitted->media->outside)->ior[meeting->channel];
    const float side = dot(dir, hit->facet) < 0.0 ? 1.0f : -1.0f;
    const vec3s facet = glms_vec3_scale(hit->facet, side);
    vec3s n = glms_vec3_scale(inclusions_crack_normal(whitted->inclusions, &hit->surface), side);
    if (!(dot(dir, n) < 0.0))
        n = facet;
    struct parting parting = part_thin(dir, n, eta);
    if (dot(parting.reflected, facet) <= 0.0)
        parting.reflected = part_at(dir, facet, eta).reflected;
    return parting;
}

/* A point of an object's surface. */
struct face {
    vec3s n, facet; /* shading normal and the triangle's, on the incident side */
    double eta;     /* index of the incident side over that of the other */
    float roughness;
    bool is_bumpy, is_thin;
};

/* Adds bumps and frost. Frost is in one sample of a pixel and not in another, by its share. */
static void weather(const struct whitted *whitted, vec3s dir, const struct meeting *meeting,
                    struct face *face)
{
    const struct inclusions *inclusions = whitted->inclusions;
    const float side = meeting->crossing.is_entering ? 1.0f : -1.0f;
    const struct inclusions_surface found = inclusions_surface_at(
        inclusions, whitted->bvh, &meeting->hit, glms_vec3_scale(face->n, side));
    face->is_bumpy = inclusions->has_bumps;
    if (face->is_bumpy)
        face->n = bump_facing(glms_vec3_scale(found.normal, side), face->n, dir);
    if (!(dot(dir, face->n) < 0.0))
        face->n = face->facet;
    if (microfacet_point(whitted->sample, microfacet_hash(meeting->seed, FROST_SEED)).x <
        found.frost)
        face->roughness = inclusions->frost_roughness;
}

static struct face face_at(const struct whitted *whitted, vec3s dir, const struct meeting *meeting)
{
    const struct bvh_hit *hit = &meeting->hit;
    const struct frame_medium *surface = medium(whitted, hit->object);
    const uint32_t before = meeting->crossing.before;
    const float side = meeting->crossing.is_entering ? 1.0f : -1.0f;
    const uint32_t after = surface->is_thin ? hit->object : meeting->crossing.after;
    struct face face = {
        .n = glms_vec3_scale(hit->surface.normal, side),
        .facet = glms_vec3_scale(hit->facet, side),
        .eta = (double)medium(whitted, before)->ior[meeting->channel] /
               (double)medium(whitted, after)->ior[meeting->channel],
        .roughness = surface->roughness,
        .is_thin = surface->is_thin,
    };
    if (whitted->params.normals == REFERENCE_NORMALS_FLAT || !(dot(dir, face.n) < 0.0))
        face.n = face.facet;
    if (hit->part == BVH_OBJECT && whitted->inclusions->is_uneven)
        weather(whitted, dir, meeting, &face);
    return face;
}

/* Takes away from what a microfacet reflects and refracts the light that others are in the way of,
 * and that which a wrong side gets. The whole surface decides how much is reflected. */
static void mask(struct parting *parting, vec3s dir, const struct face *face)
{
    const bool is_refracted = parting->fresnel < 1.0f && dot(parting->refracted, face->n) < 0.0;
    const bool is_reflected = dot(parting->reflected, face->n) > 0.0;
    parting->fresnel = (face->is_thin ? part_thin : part_at)(dir, face->n, face->eta).fresnel;
    parting->reflected_share =
        is_reflected ? microfacet_masking(face->n, parting->reflected, face->roughness) : 0.0f;
    parting->refracted_share =
        is_refracted ? microfacet_masking(face->n, parting->refracted, face->roughness) : 0.0f;
}

/* On bumpy surfaces the triangle decides on which side light is. What a microfacet sends to the
 * wrong side is lost; a smooth surface sends it as the triangle would. */
static void keep_sides(struct parting *parting, vec3s dir, const struct face *face, bool is_rough)
{
    const struct parting even = part_at(dir, face->facet, face->eta);
    const bool is_lost = parting->fresnel < 1.0f && dot(parting->refracted, face->facet) >= 0.0;
    if (is_lost && is_rough)
        parting->refracted_share = 0.0f;
    else if (is_lost && even.fresnel < 1.0f)
        parting->refracted = even.refracted;
    else if (is_lost)
        *parting = even;
    if (dot(parting->reflected, face->facet) > 0.0)
        return;
    if (is_rough)
        parting->reflected_share = 0.0f;
    parting->reflected = even.reflected;
}

/* Parts the light of a ray at a crack, at a smooth surface or, at one of its microfacets, a rough
 * one. */
static struct parting part(const struct whitted *whitted, vec3s dir, const struct meeting *meeting)
{
    if (meeting->hit.part == BVH_CRACKS)
        return part_gap(whitted, dir, meeting);
    const struct face face = face_at(whitted, dir, meeting);
    const bool is_rough = face.roughness > ROUGHNESS_MIN;
    const vec3s m = is_rough ? microfacet_sample(face.n, dir, face.roughness,
                                                 microfacet_point(whitted->sample, meeting->seed))
                             : face.n;
    struct parting parting = face.is_thin ? part_thin(dir, m, face.eta) : part_at(dir, m, face.eta);
    if (is_rough)
        mask(&parting, dir, &face);
    else if (!meeting->crossing.is_entering && dot(parting.reflected, face.facet) <= 0.0)
        parting.reflected = part_at(dir, face.facet, face.eta).reflected;
    if (face.is_bumpy)
        keep_sides(&parting, dir, &face, is_rough);
    return parting;
}

/* ---- the tree ---- */

static vec3s absorbed(const struct whitted *whitted, const struct branch *b, float length)
{
    const vec3s absorption =
        medium(whitted, media_top(whitted->media, &b->inside, MEDIA_NOTHING))->absorption;
    vec3s weight = b->weight;
    for (int k = 0; k < 3; k++)
        weight.raw[k] *= absorption.raw[k] > 0.0f ? expf(-absorption.raw[k] * length) : 1.0f;
    return weight;
}

/* Returns the crossing of a ray that has met an object. A thin wall has no medium of its own. */
static struct media_crossing crossing_at(const struct whitted *whitted,
                                         const struct media_set *inside, vec3s dir,
                                         const struct bvh_hit *hit)
{
    struct media_crossing crossing =
        media_cross(whitted->media, inside, hit->object, dot(hit->facet, dir) < 0.0);
    if (medium(whitted, hit->object)->is_thin) {
        crossing.before = media_top(whitted->media, inside, hit->object);
        crossing.after = crossing.before;
    }
    return crossing;
}

/* Returns the branch that goes on at a surface, on the other side of it or on the same. */
static struct branch leave(const struct whitted *whitted, const struct branch *b,
                           const struct meeting *meeting, vec3s dir, bool is_through)
{
    const struct bvh_hit *hit = &meeting->hit;
    const bool is_entering = meeting->crossing.is_entering;
    struct branch next = {
        .ray = {
            .origin = hit->surface.position,
            .dir = dir,
            .is_inside = is_through ? is_entering : !is_entering,
            .is_astray = is_through == is_entering ? dot(dir, hit->facet) >= 0.0
                                                   : dot(dir, hit->facet) <= 0.0,
            .from = hit->triangle,
            .part = hit->part,
            .object = hit->object,
        },
        .inside = b->inside,
        .bounces = b->bounces + 1,
        .seed = microfacet_hash(b->seed, is_through),
    };
    if (hit->part != BVH_CRACKS && !medium(whitted, hit->object)->is_thin)
        media_set_put(&next.inside, hit->object, next.ray.is_inside);
    return next;
}

/* Returns whether a branch is in an object itself, and not in a bubble. */
static bool is_in(const struct whitted *whitted, const struct branch *b, uint32_t object)
{
    return media_top(whitted->media, &b->inside, MEDIA_NOTHING) == object;
}

/* Lets a branch pass a sheet on which its light does not part: a plane of air, or a sheet that is
 * not in the ice. */
static void pass(const struct whitted *whitted, struct branch *b, const struct bvh_hit *hit)
{
    if (hit->part == BVH_AIR && is_in(whitted, b, hit->object)) {
        const struct inclusions *inclusions = whitted->inclusions;
        const float cover = inclusions_air_cover(inclusions, &hit->surface, b->ray.dir);
        const vec3s light = glms_vec3_mul(b->weight, inclusions->air_light);
        b->air = glms_vec3_muladds(light, cover, b->air);
        b->weight = glms_vec3_scale(b->weight, 1.0f - cover);
    }
    b->ray.origin = hit->surface.position;
    b->ray.near = 0.0f;
    b->ray.from = BVH_NOWHERE;
}

/*
 * Finds the next surface that parts the light of a branch, or a surface around the objects. What
 * lies between two equal media is no surface. The branch then ends there, with the weight that is
 * left. Returns false if there is none.
 */
static bool advance(const struct whitted *whitted, struct branch *b, struct meeting *meeting)
{
    while (b->bounces < whitted->params.bounces && bvh_meet(whitted->bvh, &b->ray, &meeting->hit)) {
        const struct bvh_hit *hit = &meeting->hit;
        b->weight = absorbed(whitted, b, hit->distance);
        if (hit->part == BVH_SURROUNDINGS)
            return true;
        meeting->seed = b->seed;
        if (hit->part == BVH_CRACKS && is_in(whitted, b, hit->object))
            return true;
        if (hit->part == BVH_CRACKS || hit->part == BVH_AIR) {
            pass(whitted, b, hit);
            continue;
        }
        meeting->crossing = crossing_at(whitted, &b->inside, b->ray.dir, hit);
        if (medium(whitted, hit->object)->is_thin ||
            !media_are_alike(whitted->media, meeting->crossing.before, meeting->crossing.after))
            return true;
        const struct branch before = *b;
        *b = leave(whitted, b, meeting, b->ray.dir, true);
        b->weight = before.weight;
        b->air = before.air;
    }
    return false;
}

/* Pushes a branch, or adds its weight to `remaining` if it is terminated. */
static void grow(const struct whitted *whitted, struct branch *stack, uint32_t *count,
                 struct branch branch, struct sum *sum)
{
    if (glms_vec3_max(branch.weight) < whitted->params.cutoff ||
        branch.bounces >= whitted->params.bounces)
        sum->remaining = glms_vec3_add(sum->remaining, branch.weight);
    else
        stack[(*count)++] = branch;
}

/* Adds the light of what a branch has met around the objects, or of the sky. Through a blended
 * surface the branch goes on, with the weight that is left; returns whether any is. */
static bool meet_surroundings(const struct whitted *whitted, const struct bvh_hit *hit,
                              struct branch *b, struct sum *sum)
{
    if (!hit) {
        const vec3s sky = radiance_sky(whitted->radiance, b->ray.dir);
        sum->light = glms_vec3_muladd(b->weight, sky, sum->light);
        return false;
    }
    const struct radiance_point point = {
        .vertex = &hit->surface,
        .extra = &hit->extra,
        .along_u = hit->along_u,
        .along_v = hit->along_v,
        .dir = b->ray.dir,
    };
    const vec3s light = radiance_surface(whitted->radiance, &point);
    const float passing = radiance_passing(whitted->radiance, &hit->surface);
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->weight, light), 1.0f - passing, sum->light);
    b->ray = (struct bvh_ray){ .origin = hit->surface.position,
                               .dir = b->ray.dir,
                               .near = whitted->bvh->hair,
                               .from = BVH_NOWHERE };
    b->weight = glms_vec3_scale(b->weight, passing);
    b->air = glms_vec3_zero(); /* has been counted */
    b->bounces++;
    return passing > 0.0f;
}

/* Returns what a surface takes away of light that passes it: an object's, or nothing's. */
static const struct frame_medium *surface_of(const struct whitted *whitted,
                                             const struct meeting *meeting)
{
    const bool is_gap = meeting->hit.part == BVH_CRACKS;
    return medium(whitted, is_gap ? whitted->media->outside : meeting->hit.object);
}

/* The two branches of light that meets a surface. */
struct fork {
    struct parting parting;
    struct branch reflected, refracted;
};

static struct fork fork_at(const struct whitted *whitted, const struct branch *b,
                           const struct meeting *meeting)
{
    const struct frame_medium *surface = surface_of(whitted, meeting);
    struct fork fork = { .parting = part(whitted, b->ray.dir, meeting) };
    const struct parting *p = &fork.parting;
    fork.reflected = leave(whitted, b, meeting, p->reflected, false);
    fork.reflected.weight = glms_vec3_scale(b->weight, p->fresnel * p->reflected_share);
    fork.refracted = leave(whitted, b, meeting, p->refracted, true);
    fork.refracted.weight =
        glms_vec3_scale(glms_vec3_mul(b->weight, surface->tint),
                        (1.0f - p->fresnel) * p->refracted_share * (1.0f - surface->shine));
    return fork;
}

/* Adds what an object's surface itself shows where it is not wholly transmissive. */
static void add_shine(const struct whitted *whitted, const struct branch *b,
                      const struct meeting *meeting, float fresnel, struct sum *sum)
{
    const struct frame_medium *surface = surface_of(whitted, meeting);
    if (!(surface->shine > 0.0f))
        return;
    const struct radiance_point point = { .vertex = &meeting->hit.surface,
                                          .dir = b->ray.dir,
                                          .is_base = true };
    const vec3s light = glms_vec3_mul(surface->tint, radiance_surface(whitted->radiance, &point));
    sum->light = glms_vec3_muladds(glms_vec3_mul(b->weight, light),
                                   surface->shine * (1.0f - fresnel), sum->light);
}

/* Traces a branch and its descendants, depth first: one of each two waits on the stack. */
static void follow(const struct whitted *whitted, struct branch first, uint32_t channel,
                   struct sum *sum)
{
    struct branch stack[REFERENCE_BOUNCES_MAX + 1];
    uint32_t count = 0;
    grow(whitted, stack, &count, first, sum);
    while (count) {
        struct branch b = stack[--count];
        struct meeting meeting = { .channel = channel };
        const bool is_met = advance(whitted, &b, &meeting);
        sum->light = glms_vec3_add(sum->light, b.air);
        if (!is_met && b.bounces >= whitted->params.bounces) {
            sum->remaining = glms_vec3_add(sum->remaining, b.weight);
            continue;
        }
        if (!is_met || meeting.hit.part == BVH_SURROUNDINGS) {
            if (meet_surroundings(whitted, is_met ? &meeting.hit : NULL, &b, sum))
                grow(whitted, stack, &count, b, sum);
            continue;
        }
        const struct fork fork = fork_at(whitted, &b, &meeting);
        add_shine(whitted, &b, &meeting, fork.parting.fresnel, sum);
        grow(whitted, stack, &count, fork.refracted, sum);
        grow(whitted, stack, &count, fork.reflected, sum);
    }
}

/* ---- layers ---- */

/* Traces the path that is refracted wherever that is possible, from its entry to its first exit. */
static void follow_straight(const struct whitted *whitted, struct branch b,
                            struct reference_seen *seen)
{
    float length = 0.0f;
    uint32_t bounces = 0;
    struct meeting meeting = { .channel = 1 };
    while (media_top(whitted->media, &b.inside, MEDIA_NOTHING) != whitted->media->outside &&
           b.bounces < whitted->params.bounces) {
        const vec3s from = b.ray.origin;
        if (!advance(whitted, &b, &meeting))
            break;
        length += glms_vec3_distance(from, meeting.hit.surface.position);
        if (meeting.hit.part == BVH_SURROUNDINGS)
            break;
        const struct fork fork = fork_at(whitted, &b, &meeting);
        const bool is_total = fork.parting.fresnel >= 1.0f;
        bounces += is_total;
        b = is_total ? fork.reflected : fork.refracted;
    }
    seen->exit = b.ray.dir;
    seen->path = length;
    seen->bounces = (float)bounces;
    seen->tir =
        bounces ? 1.0f : 0.0f; /* without total reflection it leaves at the first inner surface */
}

/* Traces one channel, or all of them if `channels` is 1, 1, 1, from the first surface on. */
static void look_at_object(const struct whitted *whitted, const struct branch *eye,
                           const struct meeting *met, uint32_t channel, vec3s channels,
                           struct reference_seen *seen)
{
    struct meeting meeting = *met;
    meeting.channel = channel;
    const struct fork fork = fork_at(whitted, eye, &meeting);
    const struct branch *const branches[2] = { &fork.reflected, &fork.refracted };
    const float shares[2] = { fork.parting.fresnel, 1.0f - fork.parting.fresnel };
    vec3s *const seen_light[2] = { &seen->reflection, &seen->refraction };
    struct sum shine = { 0 };
    add_shine(whitted, eye, &meeting, fork.parting.fresnel, &shine);
    seen->color = glms_vec3_muladd(shine.light, channels, seen->color);
    for (int i = 0; i < 2; i++) {
        struct sum sum = { 0 };
        struct branch branch = *branches[i];
        if (!(shares[i] > 0.0f))
            continue;
        branch.weight = glms_vec3_mul(branch.weight, channels);
        follow(whitted, branch, channel, &sum);
        seen->color = glms_vec3_add(seen->color, sum.light);
        seen->remaining = glms_vec3_add(seen->remaining, sum.remaining);
        *seen_light[i] = glms_vec3_muladds(sum.light, 1.0f / shares[i], *seen_light[i]);
    }
}

void whitted_immerse(const struct whitted *whitted, vec3s point, struct media_set *inside)
{
    struct media_set entered = { 0 };
    struct bvh_hit hit;
    struct bvh_ray ray = { .origin = point,
                           .dir = { { 0.36f, 0.8f, 0.48f } },
                           .from = BVH_NOWHERE };
    *inside = (struct media_set){ 0 };
    for (uint32_t i = 0; i < CROSSINGS_MAX && bvh_meet(whitted->bvh, &ray, &hit); i++) {
        const bool is_entering = dot(hit.facet, ray.dir) < 0.0;
        const bool is_medium = hit.part == BVH_OBJECT || hit.part == BVH_BUBBLES;
        if (is_medium && is_entering)
            media_set_put(&entered, hit.object, true);
        else if (is_medium && !media_set_has(&entered, hit.object))
            media_set_put(inside, hit.object, true);
        else if (is_medium)
            media_set_put(&entered, hit.object, false);
        ray.origin = hit.surface.position;
        ray.near = whitted->bvh->hair;
    }
}

/* Returns the number of paths of a pixel, one for each channel or one of all, and the channels of
 * a path. */
static uint32_t channel_count(const struct whitted *whitted)
{
    return whitted->media->is_dispersive ? WHITTED_CHANNEL_COUNT : 1;
}

static vec3s channels_of(const struct whitted *whitted, uint32_t path)
{
    vec3s channels = glms_vec3_zero();
    if (!whitted->media->is_dispersive)
        return glms_vec3_one();
    channels.raw[path] = 1.0f;
    return channels;
}

/* Adds what is seen behind a blended surface that the eye sees first. */
static void look_through(const struct whitted *whitted, const struct branch *behind,
                         struct reference_seen *seen)
{
    for (uint32_t c = 0; c < channel_count(whitted); c++) {
        struct branch b = *behind;
        struct sum sum = { 0 };
        b.weight = glms_vec3_mul(b.weight, channels_of(whitted, c));
        follow(whitted, b, c, &sum);
        seen->color = glms_vec3_add(seen->color, sum.light);
        seen->remaining = glms_vec3_add(seen->remaining, sum.remaining);
    }
}

struct reference_seen whitted_trace(const struct whitted *whitted, const struct bvh_ray *ray,
                                    vec3s forward, uint32_t seed)
{
    struct reference_seen seen = { .alpha = 1.0f, .z = GBUFFER_NOTHING };
    struct branch eye = {
        .ray = *ray,
        .inside = whitted->eye_inside,
        .weight = glms_vec3_one(),
        .seed = seed,
    };
    struct meeting meeting = { .channel = 1 };
    const bool is_met = advance(whitted, &eye, &meeting);
    const struct bvh_hit *hit = &meeting.hit;
    seen.color = eye.air;
    if (is_met) {
        seen.z = glms_vec3_dot(glms_vec3_sub(hit->surface.position, ray->origin), forward);
        seen.normal = hit->surface.normal;
        seen.position = hit->surface.position;
    }
    if (!is_met && whitted->radiance->scene->is_hidden) {
        seen.alpha = 0.0f;
        return seen;
    }
    if (!is_met || hit->part == BVH_SURROUNDINGS) {
        struct sum sum = { 0 };
        if (meet_surroundings(whitted, is_met ? hit : NULL, &eye, &sum))
            look_through(whitted, &eye, &seen);
        seen.color = glms_vec3_add(seen.color, sum.light);
        return seen;
    }
    const struct fork straight = fork_at(whitted, &eye, &meeting);
    seen.fresnel = straight.parting.fresnel;
    follow_straight(whitted, straight.refracted, &seen);
    for (uint32_t c = 0; c < channel_count(whitted); c++)
        look_at_object(whitted, &eye, &meeting, c, channels_of(whitted, c), &seen);
    return seen;
}
