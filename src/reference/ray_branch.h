/* ray_branch.h: a ray with throughput and medium stack, advanced from one surface to the next. */
#ifndef FIRN_REFERENCE_RAY_BRANCH_H
#define FIRN_REFERENCE_RAY_BRANCH_H

#include "src/reference/dielectric_split.h"
#include "src/reference/reference_layers.h"
#include "src/reference/tracer.h"

struct ray_branch {
    struct embree_scene_ray ray;
    struct nested_media_set inside; /* objects that contain the ray's origin */
    vec3s throughput;
    vec3s air;        /* radiance from air inclusions since the last surface */
    uint32_t bounces; /* surfaces hit so far */
    uint32_t seed;    /* seed of the random numbers at the next surface */
    uint32_t scatterings;
    uint32_t met;            /* bits of enum reference_inclusion: inclusions hit so far */
    bool ignores_scattering; /* scattering media do not deflect it; used for layers */
    bool is_gather_ray;      /* gathers light at a surface of the surroundings (light_gather.h) */
    bool is_single_path;     /* samples reflection or refraction instead of splitting */
};

/* The reflected and the refracted ray at a surface. */
struct fork {
    struct dielectric_split split;
    struct ray_branch reflected, refracted;
};

/*
 * Advances a ray to the next surface that splits it, or to the surroundings, and multiplies its
 * throughput by the transmittance on the way. Boundaries between equal media are skipped. In
 * scattering media the ray may change its direction before. Returns false if nothing is hit, or if
 * the ray has reached its limit of surfaces.
 */
bool ray_branch_advance(const struct tracer *tracing, struct ray_branch *b,
                        struct surface_hit *surface_hit);

/* Continues a ray behind a transparent surface, with its throughput multiplied by `passing`. */
void ray_branch_pass(const struct tracer *tracing, struct ray_branch *b,
                     const struct embree_scene_hit *hit, float passing);

/* Returns true if a ray has reached its limit of surfaces or scattering events. With
 * reference.russian_roulette the limit is higher than reference.bounces, since Russian roulette
 * ends paths. */
bool ray_branch_is_exhausted(const struct tracer *tracing, const struct ray_branch *b);

/* Returns true if a ray is in the medium of an object, and not in a bubble inside it. */
bool ray_branch_is_in(const struct tracer *tracing, const struct ray_branch *b, uint32_t object);

/* Returns true if a ray is in ice that scatters light. */
bool ray_branch_is_in_scattering(const struct tracer *tracing, const struct ray_branch *b);

/* Returns the medium with the surface properties of a hit: the object's or, at a crack, air. */
const struct frame_medium *ray_branch_surface(const struct tracer *tracing,
                                              const struct surface_hit *surface_hit);

struct fork ray_branch_split(const struct tracer *tracing, const struct ray_branch *b,
                             const struct surface_hit *surface_hit);

/* Applies Russian roulette to a ray whose throughput is below reference.cutoff: it survives with
 * probability throughput / cutoff, reweighted so that the estimate stays unbiased. A ray that has
 * split too often becomes a single path. Returns false if the ray is terminated. */
bool ray_branch_roulette(const struct tracer *tracing, struct ray_branch *b);

/* Samples one of reflection and refraction by Fresnel reflectance, divided by its probability. */
struct ray_branch ray_branch_choose(const struct tracer *tracing, const struct ray_branch *b,
                                    const struct fork *fork);

#endif
