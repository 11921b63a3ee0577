/* branch.h: a ray with throughput and medium stack, advanced from one surface to the next. */
#ifndef FIRN_REFERENCE_BRANCH_H
#define FIRN_REFERENCE_BRANCH_H

#include "src/reference/parting.h"
#include "src/reference/reference_layers.h"
#include "src/reference/tracing.h"

struct ray_branch {
    struct bvh_ray ray;
    struct media_set inside; /* objects that contain the ray's origin */
    vec3s throughput;
    vec3s air;        /* radiance from air inclusions since the last surface */
    uint32_t bounces; /* surfaces hit so far */
    uint32_t seed;    /* seed of the random numbers at the next surface */
    uint32_t scatterings;
    uint32_t met;            /* bits of enum reference_met: inclusions hit so far */
    bool ignores_scattering; /* scattering media do not deflect it; used for layers */
    bool is_gather_ray;      /* gathers light at a surface of the surroundings (ground.h) */
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
bool branch_advance(const struct tracer *tracing, struct ray_branch *b, struct meeting *meeting);

/* Continues a ray behind a transparent surface, with its throughput multiplied by `passing`. */
void branch_pass(const struct tracer *tracing, struct ray_branch *b, const struct bvh_hit *hit,
                 float passing);

/* Returns true if a ray has reached its limit of surfaces or scattering events. With
 * reference.roulette the limit is higher than reference.bounces, since Russian roulette ends paths.
 */
bool branch_is_spent(const struct tracer *tracing, const struct ray_branch *b);

/* Returns true if a ray is in the medium of an object, and not in a bubble inside it. */
bool branch_is_in(const struct tracer *tracing, const struct ray_branch *b, uint32_t object);

/* Returns true if a ray is in ice that scatters light. */
bool branch_is_in_cloud(const struct tracer *tracing, const struct ray_branch *b);

/* Returns the medium with the surface properties of a hit: the object's or, at a crack, air. */
const struct frame_medium *branch_surface(const struct tracer *tracing,
                                          const struct meeting *meeting);

struct fork branch_fork(const struct tracer *tracing, const struct ray_branch *b,
                        const struct meeting *meeting);

/* Applies Russian roulette to a ray whose throughput is below reference.cutoff: it survives with
 * probability throughput / cutoff, reweighted so that the estimate stays unbiased. A ray that has
 * split too often becomes a single path. Returns false if the ray is terminated. */
bool branch_goes_on(const struct tracer *tracing, struct ray_branch *b);

/* Samples one of reflection and refraction by Fresnel reflectance, divided by its probability. */
struct ray_branch branch_choose(const struct tracer *tracing, const struct ray_branch *b,
                                const struct fork *fork);

#endif
