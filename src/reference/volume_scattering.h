/*
 * volume_scattering.h: a heterogeneous medium inside an object that scatters light and absorbs
 * none.
 *
 * Free-flight distances are sampled by delta tracking (Woodcock 1965), which is unbiased for every
 * density that stays below the majorant, and needs no step size. Directions follow the phase
 * function of Henyey and Greenstein 1941.
 */
#ifndef FIRN_REFERENCE_VOLUME_SCATTERING_H
#define FIRN_REFERENCE_VOLUME_SCATTERING_H

#include "src/reference/radiance.h"
#include "src/settings/settings.h"

struct volume_scattering {
    const struct clouds *fields; /* borrowed */
    uint32_t index;              /* index of the density field */
    uint32_t object;             /* index of the object that contains the medium */
    mat4s object_from_world;
    float most;       /* majorant extinction, 1 / metre; 0 if there is no medium */
    float anisotropy; /* Henyey-Greenstein g: mean cosine of the scattering angle */
};

/* Returns the medium of density field `index` of a scene. */
struct volume_scattering volume_scattering_of(const struct radiance *radiance,
                                              const struct settings *settings, uint32_t index);

/* Returns the extinction coefficient at a world-space point, 1 / metre. */
float volume_scattering_extinction(const struct volume_scattering *volume_scattering, vec3s point);

/* A ray segment in world space. */
struct volume_scattering_segment {
    vec3s from, dir; /* dir is unit length */
    float length;    /* metres */
};

/* Samples the distance to the next scattering event by delta tracking. Returns false if there is
 * none on the segment. `sample` and `seed` select the random numbers (microfacet_point()). */
bool volume_scattering_sample_distance(const struct volume_scattering *volume_scattering,
                                       const struct volume_scattering_segment *way, uint32_t sample,
                                       uint32_t seed, float *distance);

/* Returns the optical depth along a straight shadow ray from a point to the sun, by ray marching.
 */
float volume_scattering_sun_depth(const struct volume_scattering *volume_scattering, vec3s point,
                                  vec3s to_sun);

/* Returns the Henyey-Greenstein phase function for a cosine, relative to isotropic scattering. */
float volume_scattering_phase(const struct volume_scattering *volume_scattering, float cosine);

/* Samples the Henyey-Greenstein phase function: returns the direction for a random point `at`. */
vec3s volume_scattering_sample_direction(const struct volume_scattering *volume_scattering,
                                         vec3s dir, vec2s at);

#endif
