/*
 * final_gather.h: ray-traced diffuse and glossy lighting of the surroundings (ground.light=traced).
 *
 * A surface is shaded analytically with an unoccluded sky. Each sample then adds the radiance found
 * by rays of the diffuse lobe and one ray of the specular lobe, minus the sky radiance in those
 * directions. The analytic sky is thus a control variate: an unoccluded direction contributes
 * exactly 0, and only occluders cause noise.
 *
 * Gather rays end at surroundings, which are shaded with an unoccluded sky. They exclude the sun's
 * disc: the sun is sampled separately by shadow rays (light_gather_sun()), and its caustics come
 * from the photon map (photons.h).
 */
#ifndef FIRN_LAB_REFERENCE_FINAL_GATHER_H
#define FIRN_LAB_REFERENCE_FINAL_GATHER_H

#include "shaders/lighting/diffuse_sampling.h"
#include "src/lab/reference/ray_branch.h"

enum {
    LIGHT_GATHER_RAYS = DIFFUSE_SAMPLING_RAYS + 1 /* diffuse lobe, then specular lobe */
};

/* Gather rays of a surface point. `analytic_sky` is the sky light from the directions of `rays`.
 * The caller must subtract it from the analytic shading, because that already contains it. */
struct light_gather {
    struct ray_branch rays[LIGHT_GATHER_RAYS];
    uint32_t count;
    vec3s analytic_sky;
};

/* Returns the gather rays of a hit on the surroundings, whose transmittance is `passing`. Returns
 * none if lighting is not ray-traced, the surface is unlit, or `b` is itself a gather ray. */
struct light_gather light_gather_at(const struct tracer *tracing, const struct ray_branch *b,
                                    const struct embree_scene_hit *hit,
                                    const struct radiance_point *point, float passing);

/* Traces a shadow ray to a random point of the sun's disc and returns the sun's visibility, 0 to 1.
 * Only surroundings occlude the sun. Values between 0 and 1 come from blended surfaces. */
float light_gather_sun(const struct tracer *tracing, vec3s point, uint32_t seed);

#endif
