/*
 * parting.c: reflection and refraction at cracks and at smooth, rough, bumpy and frosted surfaces.
 *
 * Fresnel equations for unpolarised light (Born and Wolf, Principles of Optics, 1.5.2) and Snell's
 * law. Differences of nearly equal numbers, as at grazing angles, are computed in double precision.
 */
#include "src/reference/parting.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/bump_normal.h"
#include "shaders/cracks.h"
#include "shaders/cracks_law.h"
#include "src/reference/microfacet.h"

enum {
    FROST_SEED = 3, /* hashed with a seed for the random number that selects frost */
};

/* Surfaces below this roughness are treated as perfectly smooth. */
#define ROUGHNESS_MIN 1e-3f

/* Returns a * d + b * n, normalised, in double precision. */
static vec3s weighted_sum(double a, vec3s d, double b, vec3s n)
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

/* Computes the directions of reflection and refraction and the Fresnel reflectance. `n` faces the
 * incident side; `eta` is the index of the incident side over that of the other side. */
static struct dielectric_split split_smooth(vec3s d, vec3s n, double eta)
{
    const double ci = fmin(-parting_dot(d, n), 1.0);
    const double sin2 = eta * eta * (1.0 - ci * ci);
    struct dielectric_split split = {
        .fresnel = 1.0f,
        .reflected = weighted_sum(1.0, d, 2.0 * ci, n),
        .reflected_share = 1.0f,
        .refracted_share = 1.0f,
    };
    if (sin2 >= 1.0)
        return split;
    const double ct = sqrt(1.0 - sin2);
    const double rs = (eta * ci - ct) / (eta * ci + ct);
    const double rp = (ci - eta * ct) / (ci + eta * ct);
    split.fresnel = (float)(0.5 * (rs * rs + rp * rp));
    split.refracted = weighted_sum(eta, d, eta * ci - ct, n);
    return split;
}

/* Computes reflection and transmission at a thin wall, including reflections inside the wall. */
static struct dielectric_split split_thin(vec3s d, vec3s n, double eta)
{
    struct dielectric_split split = split_smooth(d, n, eta);
    split.fresnel = 2.0f * split.fresnel / (1.0f + split.fresnel);
    split.refracted = d;
    return split;
}

/* Computes reflection and transmission at a crack: an air gap too thin to displace the ray. */
static struct dielectric_split split_crack(const struct tracer *tracing, vec3s dir,
                                           const struct meeting *meeting)
{
    const struct bvh_hit *hit = &meeting->hit;
    const double eta =
        (double)tracing_medium(tracing, hit->object)->ior[meeting->channel] /
        (double)tracing_medium(tracing, tracing->media->bubble)->ior[meeting->channel];
    const float side = parting_dot(dir, hit->facet) < 0.0 ? 1.0f : -1.0f;
    const vec3s facet = glms_vec3_scale(hit->facet, side);
    vec3s n = glms_vec3_scale(inclusions_crack_normal(tracing->inclusions, &hit->surface), side);
    if (!(parting_dot(dir, n) < 0.0))
        n = facet;
    struct dielectric_split split = split_thin(dir, n, eta);
    if (parting_dot(split.reflected, facet) <= 0.0)
        split.reflected = split_smooth(dir, facet, eta).reflected;
    const float open = fmaxf(CRACKS_OPEN_OF(hit->surface.color), 0.0f);
    split.colors = cracks_reflectance((float)fmin(-parting_dot(dir, n), 1.0), (float)eta,
                                      tracing->inclusions->crack_gap * sqrtf(open));
    split.fresnel = (split.colors.x + split.colors.y + split.colors.z) / 3.0f;
    return split;
}

/* The shading data of a hit on an object's surface. */
struct face {
    vec3s n, facet; /* shading normal and geometric normal, both on the incident side */
    double eta;     /* relative index: incident side over the other side */
    float roughness;
    bool is_bumpy, is_thin;
};

/* Applies bumps and frost to a hit. Frost is stochastic: its coverage is the probability that a
 * sample gets the frost's roughness. */
static void apply_bumps_and_frost(const struct tracer *tracing, vec3s dir,
                                  const struct meeting *meeting, struct face *face)
{
    const struct inclusions *inclusions = tracing->inclusions;
    const float side = meeting->crossing.is_entering ? 1.0f : -1.0f;
    const struct inclusions_surface found = inclusions_surface_at(
        inclusions, tracing->bvh, &meeting->hit, glms_vec3_scale(face->n, side));
    face->is_bumpy = face->is_bumpy || inclusions->has_bumps;
    if (inclusions->has_bumps)
        face->n = bump_facing(glms_vec3_scale(found.normal, side), face->n, dir);
    if (!(parting_dot(dir, face->n) < 0.0))
        face->n = face->facet;
    if (microfacet_point(tracing->sample, microfacet_hash(meeting->seed, FROST_SEED)).x <
        found.frost)
        face->roughness = inclusions->frost_roughness;
}

/* Replaces the shading normal by that of a normal map, given on the incident side. */
static void apply_normal_map(vec3s dir, vec3s normal, struct face *face)
{
    face->n = bump_facing(normal, face->n, dir);
    if (!(parting_dot(dir, face->n) < 0.0))
        face->n = face->facet;
    face->is_bumpy = true;
}

static struct face face_at(const struct tracer *tracing, vec3s dir, const struct meeting *meeting)
{
    const struct bvh_hit *hit = &meeting->hit;
    const struct frame_medium *surface = tracing_medium(tracing, hit->object);
    const uint32_t before = meeting->crossing.before;
    const float side = meeting->crossing.is_entering ? 1.0f : -1.0f;
    const uint32_t after = surface->is_thin ? hit->object : meeting->crossing.after;
    struct face face = {
        .n = glms_vec3_scale(hit->surface.normal, side),
        .facet = glms_vec3_scale(hit->facet, side),
        .eta = (double)tracing_medium(tracing, before)->ior[meeting->channel] /
               (double)tracing_medium(tracing, after)->ior[meeting->channel],
        .roughness = meeting->dress.roughness,
        .is_thin = surface->is_thin,
    };
    if (tracing->params.normals == REFERENCE_NORMALS_FLAT || !(parting_dot(dir, face.n) < 0.0))
        face.n = face.facet;
    if (meeting->is_bent && tracing->params.normals != REFERENCE_NORMALS_FLAT)
        apply_normal_map(dir, glms_vec3_scale(meeting->normal, side), &face);
    if (hit->part == BVH_OBJECT && tracing->inclusions->is_uneven)
        apply_bumps_and_frost(tracing, dir, meeting, &face);
    return face;
}

/* Applies masking and shadowing to the sampled microfacet, and rejects directions on the wrong
 * side. The reflectance becomes that of the macroscopic surface. */
static void apply_masking(struct dielectric_split *split, vec3s dir, const struct face *face)
{
    const bool is_refracted = split->fresnel < 1.0f && parting_dot(split->refracted, face->n) < 0.0;
    const bool is_reflected = parting_dot(split->reflected, face->n) > 0.0;
    split->fresnel = (face->is_thin ? split_thin : split_smooth)(dir, face->n, face->eta).fresnel;
    split->reflected_share =
        is_reflected ? microfacet_masking(face->n, split->reflected, face->roughness) : 0.0f;
    split->refracted_share =
        is_refracted ? microfacet_masking(face->n, split->refracted, face->roughness) : 0.0f;
}

/* Ensures that directions at a bumpy surface lie on the correct side of the triangle. A rough
 * surface loses light that leaves to the wrong side; a smooth one uses the direction at the
 * geometric normal instead. */
static void fix_sides(struct dielectric_split *split, vec3s dir, const struct face *face,
                      bool is_rough)
{
    const struct dielectric_split smooth = split_smooth(dir, face->facet, face->eta);
    const bool is_lost = split->fresnel < 1.0f && parting_dot(split->refracted, face->facet) >= 0.0;
    if (is_lost && is_rough)
        split->refracted_share = 0.0f;
    else if (is_lost && smooth.fresnel < 1.0f)
        split->refracted = smooth.refracted;
    else if (is_lost)
        *split = smooth;
    if (parting_dot(split->reflected, face->facet) > 0.0)
        return;
    if (is_rough)
        split->reflected_share = 0.0f;
    split->reflected = smooth.reflected;
}

/* Computes reflection and refraction at an object's surface, at a sampled microfacet if rough. */
static struct dielectric_split split_surface(const struct tracer *tracing, vec3s dir,
                                             const struct meeting *meeting)
{
    const struct face face = face_at(tracing, dir, meeting);
    const bool is_rough = face.roughness > ROUGHNESS_MIN;
    const vec3s m = is_rough ? microfacet_sample(face.n, dir, face.roughness,
                                                 microfacet_point(tracing->sample, meeting->seed))
                             : face.n;
    struct dielectric_split split =
        face.is_thin ? split_thin(dir, m, face.eta) : split_smooth(dir, m, face.eta);
    if (is_rough)
        apply_masking(&split, dir, &face);
    else if (!meeting->crossing.is_entering && parting_dot(split.reflected, face.facet) <= 0.0)
        split.reflected = split_smooth(dir, face.facet, face.eta).reflected;
    if (face.is_bumpy)
        fix_sides(&split, dir, &face, is_rough);
    return split;
}

struct dielectric_split parting_at(const struct tracer *tracing, vec3s dir,
                                   const struct meeting *meeting)
{
    if (meeting->hit.part == BVH_CRACKS)
        return split_crack(tracing, dir, meeting);
    struct dielectric_split split = split_surface(tracing, dir, meeting);
    split.colors = (vec3s){ { split.fresnel, split.fresnel, split.fresnel } };
    return split;
}
