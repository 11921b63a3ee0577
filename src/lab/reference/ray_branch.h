/* ray_branch.h: ray with throughput and medium stack, traced from surface to surface. */
#ifndef FIRN_LAB_REFERENCE_RAY_BRANCH_H
#define FIRN_LAB_REFERENCE_RAY_BRANCH_H

#include "src/lab/reference/dielectric_split.h"
#include "src/lab/reference/reference_aov_table.h"
#include "src/lab/reference/tracer_context.h"

struct ray_branch {
    struct embree_scene_ray ray;
    struct nested_media_set inside; /* objects that contain the ray's origin */
    vec3s throughput;
    vec3s air;        /* radiance of air passed since then */
    uint32_t bounces; /* surfaces hit so far */
    uint32_t seed;    /* for the next surface's random numbers */
    uint32_t scatterings;
    uint32_t inclusion_bits; /* enum reference_inclusion bits hit so far */
    bool ignores_scattering; /* passes scattering media undeflected, for layers */
    bool is_gather_ray;      /* gathers light at surroundings (final_gather.h) */
    bool is_single_path;     /* samples reflection or refraction, never branches */
    bool shows_backdrop;     /* has only been refracted, and the image has no background */
};

/* Both branches at a surface: the reflected and the refracted ray. */
struct fork {
    struct dielectric_split split;
    struct ray_branch reflected, refracted;
};

/*
 * Advances a ray to the next surface that splits it, or to the surroundings. Multiplies the
 * throughput by the transmittance. Passes boundaries between equal media. A scattering medium may
 * deflect the ray. Returns false if nothing is hit, or if ray_branch_is_exhausted() ends the ray.
 */
bool ray_branch_advance(const struct tracer *tracing, struct ray_branch *b,
                        struct surface_hit *surface_hit);

/* Continues a ray through a transparent surface of transmittance `passing`. */
void ray_branch_pass(const struct tracer *tracing, struct ray_branch *b,
                     const struct embree_scene_hit *hit, float passing);

/* Returns true if a ray has reached its limit of surfaces or of scattering events. The limit of
 * surfaces is reference.bounces. With Russian roulette, it is higher. */
bool ray_branch_is_exhausted(const struct tracer *tracing, const struct ray_branch *b);

/* Returns true if a ray's medium is that of `object`. Bubbles in the object have another medium. */
bool ray_branch_is_in(const struct tracer *tracing, const struct ray_branch *b, uint32_t object);

bool ray_branch_is_in_scattering(const struct tracer *tracing, const struct ray_branch *b);

/* Returns the medium whose surface was hit: air for a crack, else the medium of the object. */
const struct frame_medium *ray_branch_surface(const struct tracer *tracing,
                                              const struct surface_hit *surface_hit);

struct fork ray_branch_split(const struct tracer *tracing, const struct ray_branch *b,
                             const struct surface_hit *surface_hit);

/* Applies Russian roulette: if the throughput is below reference.cutoff, the ray survives with
 * probability throughput / cutoff. Multiplies the throughput by the returned weight: 0 if the ray
 * is terminated, else 1 / probability. If the ray has split too often, it becomes a single path. */
float ray_branch_roulette(const struct tracer *tracing, struct ray_branch *b);

/* Chooses the reflected or refracted ray at random by Fresnel reflectance, and reweights it. */
struct ray_branch ray_branch_choose(const struct tracer *tracing, const struct ray_branch *b,
                                    const struct fork *fork);

#endif
