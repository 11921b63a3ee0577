/*
 * volume_scattering.h: scattering medium inside an object, with varying density and no absorption.
 * Free-flight distances are sampled by delta tracking (Woodcock 1965), which is unbiased.
 * Directions follow the Henyey-Greenstein phase function (1941).
 */
#ifndef FIRN_LAB_REFERENCE_VOLUME_SCATTERING_H
#define FIRN_LAB_REFERENCE_VOLUME_SCATTERING_H

#include "src/lab/reference/surroundings_radiance.h"
#include "src/settings/settings.h"

struct volume_scattering {
    const struct scattering_media *fields; /* borrowed */
    uint32_t index;                        /* index of the density field */
    uint32_t object;                       /* object that contains the medium */
    mat4s object_from_world;
    float majorant;   /* majorant extinction, 1/metre; 0 if empty */
    float anisotropy; /* Henyey-Greenstein g: mean scattering cosine */
};

/* Returns the scattering medium of the scene's density field `index`. */
struct volume_scattering volume_scattering_of(const struct radiance *radiance,
                                              const struct settings *settings, uint32_t index);

/* Returns the extinction coefficient at a world-space point, per metre. */
float volume_scattering_extinction(const struct volume_scattering *volume_scattering, vec3s point);

/* A ray segment in world space. */
struct volume_scattering_segment {
    vec3s from, dir; /* dir is unit length */
    float length;    /* metres */
};

/* Samples the distance to the next scattering event. Returns false if there is none in the segment.
 * `sample` and `seed` select the random numbers (see microfacet_point()). */
bool volume_scattering_sample_distance(const struct volume_scattering *volume_scattering,
                                       const struct volume_scattering_segment *segment,
                                       uint32_t sample, uint32_t seed, float *distance);

/* Returns the optical depth along an unrefracted shadow ray to the sun, by ray marching. */
float volume_scattering_sun_depth(const struct volume_scattering *volume_scattering, vec3s point,
                                  vec3s to_sun);

/* Samples a direction from the Henyey-Greenstein phase function. `at` is a uniform 2D sample. */
vec3s volume_scattering_sample_direction(const struct volume_scattering *volume_scattering,
                                         vec3s dir, vec2s at);

#endif
