/*
 * light_gather.h: ray-traced lighting of the surroundings: occlusion, refraction and reflection of
 * environment light by everything around a point (ground.light=traced).
 *
 * A surface is shaded analytically with an unoccluded sky. Each sample then adds the radiance found
 * by rays of the diffuse lobe and a ray of the specular lobe, minus the sky radiance in those
 * directions. The analytic sky thus is a control variate: an unoccluded direction contributes
 * exactly 0, and only occluders cause noise.
 *
 * Where such a ray ends, surroundings are shaded with an unoccluded sky, and the sun's disc is
 * excluded: the sun is sampled separately by shadow rays (light_gather_sun()), and its caustics
 * come from the photon map (photons.h).
 */
#ifndef FIRN_REFERENCE_LIGHT_GATHER_H
#define FIRN_REFERENCE_LIGHT_GATHER_H

#include "shaders/lighting/diffuse_sampling.h"
#include "src/reference/ray_branch.h"

enum {
    LIGHT_GATHER_RAYS =
        DIFFUSE_SAMPLING_RAYS + 1 /* rays of the diffuse lobe and one of the specular lobe */
};

/* Rays that gather light at a point, and the analytic sky radiance in their directions, which has
 * been added already and must be subtracted. */
struct light_gather {
    struct ray_branch rays[LIGHT_GATHER_RAYS];
    uint32_t count;
    vec3s analytic_sky;
};

/* Returns the gather rays for a ray that has hit `point` of the surroundings; `passing` is the
 * transmittance of that surface. The result is empty if no rays are needed. */
struct light_gather light_gather_at(const struct tracer *tracing, const struct ray_branch *b,
                                    const struct embree_scene_hit *hit,
                                    const struct radiance_point *point, float passing);

/* Returns the visibility of the sun at a point, with only surroundings as occluders: 0 or 1 for one
 * sampled point of the sun's disc, or in between behind blended surfaces. */
float light_gather_sun(const struct tracer *tracing, vec3s point, uint32_t seed);

#endif
