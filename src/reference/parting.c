/*
 * parting.c: cracks, smooth and rough surfaces, bumps and frost.
 *
 * Fresnel's equations for unpolarised light (Born and Wolf, Principles of Optics, 1.5.2) and
 * Snell's law. Differences of nearly equal numbers are computed in double.
 */
#include "src/reference/parting.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/bump_normal.h"
#include "shaders/cracks.h"
#include "shaders/cracks_law.h"
#include "src/reference/microfacet.h"

enum {
    FROST_SEED = 3, /* what a seed is hashed with for a random number of its own */
};

/* Rougher surfaces are not smooth. */
#define ROUGHNESS_MIN 1e-3f

/* ---- at the surface ---- */

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
    const double ci = fmin(-parting_dot(d, n), 1.0);
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

/* Parts light at a crack: a gap too thin to displace it. */
static struct parting part_gap(const struct tracing *tracing, vec3s dir,
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
    struct parting parting = part_thin(dir, n, eta);
    if (parting_dot(parting.reflected, facet) <= 0.0)
        parting.reflected = part_at(dir, facet, eta).reflected;
    const float open = fmaxf(CRACKS_OPEN_OF(hit->surface.color), 0.0f);
    parting.colors = cracks_reflectance((float)fmin(-parting_dot(dir, n), 1.0), (float)eta,
                                        tracing->inclusions->crack_gap * sqrtf(open));
    parting.fresnel = (parting.colors.x + parting.colors.y + parting.colors.z) / 3.0f;
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
static void weather(const struct tracing *tracing, vec3s dir, const struct meeting *meeting,
                    struct face *face)
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

/* Takes the normal of a texture, on the incident side. */
static void bend(vec3s dir, vec3s normal, struct face *face)
{
    face->n = bump_facing(normal, face->n, dir);
    if (!(parting_dot(dir, face->n) < 0.0))
        face->n = face->facet;
    face->is_bumpy = true;
}

static struct face face_at(const struct tracing *tracing, vec3s dir, const struct meeting *meeting)
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
        bend(dir, glms_vec3_scale(meeting->normal, side), &face);
    if (hit->part == BVH_OBJECT && tracing->inclusions->is_uneven)
        weather(tracing, dir, meeting, &face);
    return face;
}

/* Takes away from what a microfacet reflects and refracts the light that others are in the way of,
 * and that which a wrong side gets. The whole surface decides how much is reflected. */
static void mask(struct parting *parting, vec3s dir, const struct face *face)
{
    const bool is_refracted =
        parting->fresnel < 1.0f && parting_dot(parting->refracted, face->n) < 0.0;
    const bool is_reflected = parting_dot(parting->reflected, face->n) > 0.0;
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
    const bool is_lost =
        parting->fresnel < 1.0f && parting_dot(parting->refracted, face->facet) >= 0.0;
    if (is_lost && is_rough)
        parting->refracted_share = 0.0f;
    else if (is_lost && even.fresnel < 1.0f)
        parting->refracted = even.refracted;
    else if (is_lost)
        *parting = even;
    if (parting_dot(parting->reflected, face->facet) > 0.0)
        return;
    if (is_rough)
        parting->reflected_share = 0.0f;
    parting->reflected = even.reflected;
}

/* Parts light at the surface of an object. */
static struct parting part_face(const struct tracing *tracing, vec3s dir,
                                const struct meeting *meeting)
{
    const struct face face = face_at(tracing, dir, meeting);
    const bool is_rough = face.roughness > ROUGHNESS_MIN;
    const vec3s m = is_rough ? microfacet_sample(face.n, dir, face.roughness,
                                                 microfacet_point(tracing->sample, meeting->seed))
                             : face.n;
    struct parting parting = face.is_thin ? part_thin(dir, m, face.eta) : part_at(dir, m, face.eta);
    if (is_rough)
        mask(&parting, dir, &face);
    else if (!meeting->crossing.is_entering && parting_dot(parting.reflected, face.facet) <= 0.0)
        parting.reflected = part_at(dir, face.facet, face.eta).reflected;
    if (face.is_bumpy)
        keep_sides(&parting, dir, &face, is_rough);
    return parting;
}

struct parting parting_at(const struct tracing *tracing, vec3s dir, const struct meeting *meeting)
{
    if (meeting->hit.part == BVH_CRACKS)
        return part_gap(tracing, dir, meeting);
    struct parting parting = part_face(tracing, dir, meeting);
    parting.colors = (vec3s){ { parting.fresnel, parting.fresnel, parting.fresnel } };
    return parting;
}
