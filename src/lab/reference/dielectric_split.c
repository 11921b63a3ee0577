/*
 * dielectric_split.c: reflection and refraction at cracks and at smooth, rough, bumpy and frosted
 * surfaces. Uses Snell's law and the Fresnel equations for unpolarised light (Born and Wolf,
 * Principles of Optics, 1.5.2). Differences of nearly equal numbers are in double precision.
 */
#include "src/lab/reference/dielectric_split.h"
#include <cglm/struct.h>
#include <math.h>
#include "shaders/inclusions/cracks.h"
#include "shaders/inclusions/cracks_reflectance.h"
#include "shaders/lighting/bump_normal.h"
#include "shaders/microfacet.h"

enum {
    FROST_SEED = 3, /* seed constant for frost selection */
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

/* Computes reflection and refraction directions and the Fresnel reflectance. `n` is on the incident
 * side. `eta` is the incident medium's refractive index over the second medium's. */
static struct dielectric_split split_smooth(vec3s d, vec3s n, double eta)
{
    const double ci = fmin(-dielectric_split_dot(d, n), 1.0);
    const double sin2 = eta * eta * (1.0 - ci * ci);
    struct dielectric_split split = {
        .fresnel = 1.0f,
        .reflected = weighted_sum(1.0, d, 2.0 * ci, n),
        .reflected_masking = 1.0f,
        .refracted_masking = 1.0f,
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

/* Computes reflection and transmission of a thin wall, summed over all internal reflections. */
static struct dielectric_split split_thin(vec3s d, vec3s n, double eta)
{
    struct dielectric_split split = split_smooth(d, n, eta);
    split.fresnel = 2.0f * split.fresnel / (1.0f + split.fresnel);
    split.refracted = d;
    return split;
}

/* Computes reflection and transmission at a crack: an air gap too thin to displace the ray. */
static struct dielectric_split split_crack(const struct tracer *tracing, vec3s dir,
                                           const struct surface_hit *surface_hit)
{
    const struct embree_scene_hit *hit = &surface_hit->hit;
    const double eta =
        (double)tracer_medium(tracing, hit->object)->ior[surface_hit->channel] /
        (double)tracer_medium(tracing, tracing->media->bubble)->ior[surface_hit->channel];
    const float side = dielectric_split_dot(dir, hit->facet) < 0.0 ? 1.0f : -1.0f;
    const vec3s facet = glms_vec3_scale(hit->facet, side);
    vec3s n = glms_vec3_scale(inclusions_crack_normal(tracing->inclusions, &hit->surface), side);
    if (!(dielectric_split_dot(dir, n) < 0.0))
        n = facet;
    struct dielectric_split split = split_thin(dir, n, eta);
    if (dielectric_split_dot(split.reflected, facet) <= 0.0)
        split.reflected = split_smooth(dir, facet, eta).reflected;
    const float open = fmaxf(CRACKS_SQUARED_GAP(hit->surface.color), 0.0f);
    split.colors = cracks_reflectance((float)fmin(-dielectric_split_dot(dir, n), 1.0), (float)eta,
                                      tracing->inclusions->crack_gap * sqrtf(open));
    split.fresnel = (split.colors.x + split.colors.y + split.colors.z) / 3.0f;
    return split;
}

/* The shading data of a hit on an object's surface. */
struct face {
    vec3s n, facet; /* shading and geometric normal */
    double eta;     /* relative index: incident over transmitted */
    float roughness;
    bool is_bumpy, is_thin;
};

/* Applies bumps to a hit, and frost with a probability equal to the frost coverage. */
static void apply_bumps_and_frost(const struct tracer *tracing, vec3s dir,
                                  const struct surface_hit *surface_hit, struct face *face)
{
    const struct inclusions *inclusions = tracing->inclusions;
    const float side = surface_hit->crossing.is_entering ? 1.0f : -1.0f;
    const struct inclusions_surface found = inclusions_surface_at(
        inclusions, tracing->embree_scene, &surface_hit->hit, glms_vec3_scale(face->n, side));
    face->is_bumpy = face->is_bumpy || inclusions->has_bumps;
    if (inclusions->has_bumps)
        face->n = bump_facing(glms_vec3_scale(found.normal, side), face->n, dir);
    if (!(dielectric_split_dot(dir, face->n) < 0.0))
        face->n = face->facet;
    if (microfacet_point(tracing->sample, microfacet_hash(surface_hit->seed, FROST_SEED)).x <
        found.frost)
        face->roughness = inclusions->frost_roughness;
}

static void apply_normal_map(vec3s dir, vec3s normal, struct face *face)
{
    face->n = bump_facing(normal, face->n, dir);
    if (!(dielectric_split_dot(dir, face->n) < 0.0))
        face->n = face->facet;
    face->is_bumpy = true;
}

static struct face face_at(const struct tracer *tracing, vec3s dir,
                           const struct surface_hit *surface_hit)
{
    const struct embree_scene_hit *hit = &surface_hit->hit;
    const struct frame_medium *surface = tracer_medium(tracing, hit->object);
    const uint32_t before = surface_hit->crossing.before;
    const float side = surface_hit->crossing.is_entering ? 1.0f : -1.0f;
    const uint32_t after = surface->is_thin ? hit->object : surface_hit->crossing.after;
    struct face face = {
        .n = glms_vec3_scale(hit->surface.normal, side),
        .facet = glms_vec3_scale(hit->facet, side),
        .eta = (double)tracer_medium(tracing, before)->ior[surface_hit->channel] /
               (double)tracer_medium(tracing, after)->ior[surface_hit->channel],
        .roughness = surface_hit->material.roughness,
        .is_thin = surface->is_thin,
    };
    if (tracing->params.normals == REFERENCE_NORMALS_FLAT ||
        !(dielectric_split_dot(dir, face.n) < 0.0))
        face.n = face.facet;
    if (surface_hit->is_bent && tracing->params.normals != REFERENCE_NORMALS_FLAT)
        apply_normal_map(dir, glms_vec3_scale(surface_hit->normal, side), &face);
    if (hit->kind == EMBREE_SCENE_OBJECT && tracing->inclusions->is_uneven)
        apply_bumps_and_frost(tracing, dir, surface_hit, &face);
    return face;
}

/* Computes the GGX masking factors. A factor is 0 if its direction is on the wrong side of the
 * surface. Recomputes the Fresnel reflectance with the macroscopic normal. */
static void apply_masking(struct dielectric_split *split, vec3s dir, const struct face *face)
{
    const bool is_refracted =
        split->fresnel < 1.0f && dielectric_split_dot(split->refracted, face->n) < 0.0;
    const bool is_reflected = dielectric_split_dot(split->reflected, face->n) > 0.0;
    split->fresnel = (face->is_thin ? split_thin : split_smooth)(dir, face->n, face->eta).fresnel;
    split->reflected_masking =
        is_reflected ? microfacet_masking(face->n, split->reflected, face->roughness) : 0.0f;
    split->refracted_masking =
        is_refracted ? microfacet_masking(face->n, split->refracted, face->roughness) : 0.0f;
}

/* Corrects directions that bumps have put on the wrong side of the triangle. If the surface is
 * rough, such directions get weight 0. Otherwise, the geometric normal replaces the bumpy one. */
static void fix_sides(struct dielectric_split *split, vec3s dir, const struct face *face,
                      bool is_rough)
{
    const struct dielectric_split smooth = split_smooth(dir, face->facet, face->eta);
    const bool is_lost =
        split->fresnel < 1.0f && dielectric_split_dot(split->refracted, face->facet) >= 0.0;
    if (is_lost && is_rough)
        split->refracted_masking = 0.0f;
    else if (is_lost && smooth.fresnel < 1.0f)
        split->refracted = smooth.refracted;
    else if (is_lost)
        *split = smooth;
    if (dielectric_split_dot(split->reflected, face->facet) > 0.0)
        return;
    if (is_rough)
        split->reflected_masking = 0.0f;
    split->reflected = smooth.reflected;
}

/* Computes reflection and refraction at an object. A rough surface is sampled at one microfacet. */
static struct dielectric_split split_surface(const struct tracer *tracing, vec3s dir,
                                             const struct surface_hit *surface_hit)
{
    const struct face face = face_at(tracing, dir, surface_hit);
    const bool is_rough = face.roughness > ROUGHNESS_MIN;
    const vec3s m = is_rough
                        ? microfacet_sample(face.n, dir, face.roughness,
                                            microfacet_point(tracing->sample, surface_hit->seed))
                        : face.n;
    struct dielectric_split split =
        face.is_thin ? split_thin(dir, m, face.eta) : split_smooth(dir, m, face.eta);
    if (is_rough)
        apply_masking(&split, dir, &face);
    else if (!surface_hit->crossing.is_entering &&
             dielectric_split_dot(split.reflected, face.facet) <= 0.0)
        split.reflected = split_smooth(dir, face.facet, face.eta).reflected;
    if (face.is_bumpy)
        fix_sides(&split, dir, &face, is_rough);
    return split;
}

struct dielectric_split dielectric_split_at(const struct tracer *tracing, vec3s dir,
                                            const struct surface_hit *surface_hit)
{
    if (surface_hit->hit.kind == EMBREE_SCENE_CRACKS)
        return split_crack(tracing, dir, surface_hit);
    struct dielectric_split split = split_surface(tracing, dir, surface_hit);
    split.colors = (vec3s){ { split.fresnel, split.fresnel, split.fresnel } };
    return split;
}
