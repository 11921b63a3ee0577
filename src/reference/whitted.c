/*
 * whitted.c: traces the branches of a ray.
 *
 * Fresnel's equations for unpolarised light (Born and Wolf, Principles of Optics, 1.5.2), Snell's
 * law, and the law of Beer and Lambert on the path inside. Differences of nearly equal numbers are
 * computed in double.
 */
#include "src/reference/whitted.h"
#include <math.h>
#include "src/tech/gbuffer.h"

/* Reflection and refraction at the object's surface. */
struct parting {
    float fresnel; /* reflectance; 1: total reflection */
    vec3s reflected, refracted;
};

struct branch {
    struct bvh_ray ray;
    vec3s weight;
    uint32_t bounces; /* surfaces that it has met */
};

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
    struct parting parting = { .fresnel = 1.0f, .reflected = combined(1.0, d, 2.0 * ci, n) };
    if (sin2 >= 1.0)
        return parting;
    const double ct = sqrt(1.0 - sin2);
    const double rs = (eta * ci - ct) / (eta * ci + ct);
    const double rp = (ci - eta * ct) / (ci + eta * ct);
    parting.fresnel = (float)(0.5 * (rs * rs + rp * rp));
    parting.refracted = combined(eta, d, eta * ci - ct, n);
    return parting;
}

static struct parting part(const struct whitted *whitted, const struct bvh_ray *ray,
                           const struct bvh_hit *hit, uint32_t channel)
{
    const float side = ray->is_inside ? -1.0f : 1.0f;
    const double outside = (double)whitted->eta[channel];
    const double eta = ray->is_inside ? 1.0 / outside : outside;
    const vec3s facet = glms_vec3_scale(hit->facet, side);
    vec3s n = glms_vec3_scale(hit->surface.normal, side);
    if (whitted->params.normals == REFERENCE_NORMALS_FLAT || !(dot(ray->dir, n) < 0.0))
        n = facet;
    struct parting parting = part_at(ray->dir, n, eta);
    if (ray->is_inside && dot(parting.reflected, facet) <= 0.0)
        parting.reflected = part_at(ray->dir, facet, eta).reflected;
    return parting;
}

static struct bvh_ray leave(const struct bvh_hit *hit, vec3s dir, bool is_inside)
{
    return (struct bvh_ray){
        .origin = hit->surface.position,
        .dir = dir,
        .is_inside = is_inside,
        .from = hit->triangle,
    };
}

/* ---- the tree ---- */

static vec3s absorbed(const struct whitted *whitted, vec3s weight, float length)
{
    for (int k = 0; k < 3; k++)
        weight.raw[k] *= expf(-whitted->absorb.raw[k] * length);
    return weight;
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

static vec3s surroundings_seen(const struct whitted *whitted, const struct bvh_ray *ray,
                               const struct bvh_hit *hit)
{
    return hit ? radiance_surface(whitted->radiance, &hit->surface, ray->dir)
               : radiance_sky(whitted->radiance, ray->dir);
}

/* Traces a branch and its descendants, depth first: one of each two waits on the stack. */
static void follow(const struct whitted *whitted, struct branch first, uint32_t channel,
                   struct sum *sum)
{
    struct branch stack[REFERENCE_BOUNCES_MAX + 1];
    uint32_t count = 0;
    grow(whitted, stack, &count, first, sum);
    while (count) {
        const struct branch b = stack[--count];
        struct bvh_hit hit;
        const bool is_met = bvh_meet(whitted->bvh, &b.ray, &hit);
        const vec3s weight =
            is_met && b.ray.is_inside ? absorbed(whitted, b.weight, hit.distance) : b.weight;
        if (!is_met || hit.part == BVH_SURROUNDINGS) {
            const vec3s light = surroundings_seen(whitted, &b.ray, is_met ? &hit : NULL);
            sum->light = glms_vec3_add(sum->light, glms_vec3_mul(weight, light));
            continue;
        }
        const struct parting parting = part(whitted, &b.ray, &hit, channel);
        grow(whitted, stack, &count,
             (struct branch){
                 .ray = leave(&hit, parting.refracted, !b.ray.is_inside),
                 .weight = glms_vec3_scale(weight, 1.0f - parting.fresnel),
                 .bounces = b.bounces + 1,
             },
             sum);
        grow(whitted, stack, &count,
             (struct branch){
                 .ray = leave(&hit, parting.reflected, b.ray.is_inside),
                 .weight = glms_vec3_scale(weight, parting.fresnel),
                 .bounces = b.bounces + 1,
             },
             sum);
    }
}

/* ---- layers ---- */

/* Traces the path that is refracted wherever that is possible, from its entry to its first exit. */
static void follow_straight(const struct whitted *whitted, struct bvh_ray ray,
                            struct reference_seen *seen)
{
    struct bvh_hit hit;
    float length = 0.0f;
    uint32_t bounces = 0;
    while (ray.is_inside && bounces < whitted->params.bounces &&
           bvh_meet(whitted->bvh, &ray, &hit)) {
        length += hit.distance;
        if (hit.part == BVH_SURROUNDINGS)
            break;
        const struct parting parting = part(whitted, &ray, &hit, 1);
        const bool is_total = parting.fresnel >= 1.0f;
        bounces += is_total;
        ray = leave(&hit, is_total ? parting.reflected : parting.refracted, is_total);
    }
    seen->exit = ray.dir;
    seen->path = length;
    seen->bounces = (float)bounces;
    seen->tir =
        bounces ? 1.0f : 0.0f; /* without total reflection it leaves at the first inner surface */
}

/* Traces one channel, or all of them if `channels` is 1, 1, 1. */
static void look_at_object(const struct whitted *whitted, const struct bvh_ray *ray,
                           const struct bvh_hit *hit, uint32_t channel, vec3s channels,
                           struct reference_seen *seen)
{
    const struct parting parting = part(whitted, ray, hit, channel);
    const float shares[2] = { parting.fresnel, 1.0f - parting.fresnel };
    const struct bvh_ray rays[2] = {
        leave(hit, parting.reflected, false),
        leave(hit, parting.refracted, true),
    };
    vec3s *const seen_light[2] = { &seen->reflection, &seen->refraction };
    for (int i = 0; i < 2; i++) {
        struct sum sum = { 0 };
        if (!(shares[i] > 0.0f))
            continue;
        follow(whitted,
               (struct branch){ rays[i], .weight = glms_vec3_scale(channels, shares[i]),
                                .bounces = 1 },
               channel, &sum);
        seen->color = glms_vec3_add(seen->color, sum.light);
        seen->remaining = glms_vec3_add(seen->remaining, sum.remaining);
        *seen_light[i] = glms_vec3_muladds(sum.light, 1.0f / shares[i], *seen_light[i]);
    }
}

struct reference_seen whitted_trace(const struct whitted *whitted, const struct bvh_ray *ray,
                                    vec3s forward)
{
    struct reference_seen seen = { .alpha = 1.0f, .z = GBUFFER_NOTHING };
    struct bvh_hit hit;
    const bool is_met = bvh_meet(whitted->bvh, ray, &hit);
    if (is_met) {
        seen.z = hit.distance * glms_vec3_dot(ray->dir, forward);
        seen.normal = hit.surface.normal;
        seen.position = hit.surface.position;
    }
    if (!is_met || hit.part == BVH_SURROUNDINGS) {
        seen.color = surroundings_seen(whitted, ray, is_met ? &hit : NULL);
        return seen;
    }
    const struct parting straight = part(whitted, ray, &hit, 1);
    seen.fresnel = straight.fresnel;
    follow_straight(whitted, leave(&hit, straight.refracted, true), &seen);
    for (uint32_t c = 0; c < WHITTED_CHANNEL_COUNT; c++) {
        vec3s channels = glms_vec3_one();
        if (whitted->is_dispersive) {
            channels = glms_vec3_zero();
            channels.raw[c] = 1.0f;
        }
        if (c == 0 || whitted->is_dispersive)
            look_at_object(whitted, ray, &hit, c, channels, &seen);
    }
    return seen;
}
