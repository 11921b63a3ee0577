/*
 * cloud.h: cloudy ice: a medium that scatters light and absorbs none (scene.clouds).
 *
 * A free path is found by delta tracking (Woodcock 1965), which is exact for any density below the
 * greatest; directions are those of Henyey and Greenstein 1941.
 */
#ifndef FIRN_REFERENCE_CLOUD_H
#define FIRN_REFERENCE_CLOUD_H

#include "src/reference/radiance.h"
#include "src/settings/settings.h"

struct cloud {
    const struct clouds *fields; /* borrowed */
    uint32_t index;              /* of the cloud in it */
    uint32_t object;             /* that it is in */
    mat4s object_from_world;
    float most;       /* greatest extinction, 1 / metre; 0: there is no cloud */
    float anisotropy; /* mean cosine of the angle by which light is turned */
};

/* Returns cloud `index` of a scene. */
struct cloud cloud_of(const struct radiance *radiance, const struct settings *settings,
                      uint32_t index);

/* Returns the extinction at a point of the world, 1 / metre. */
float cloud_density(const struct cloud *cloud, vec3s point);

/* A straight way in the world. */
struct cloud_way {
    vec3s from, dir; /* dir is unit */
    float length;    /* metres */
};

/* Returns whether light is scattered on a way, and after which distance. Random numbers are those
 * of `sample` and `seed` (microfacet_point()). */
bool cloud_scatters(const struct cloud *cloud, const struct cloud_way *way, uint32_t sample,
                    uint32_t seed, float *distance);

/* Returns the scatterings on the straight way from a point to the sun. */
float cloud_sun_depth(const struct cloud *cloud, vec3s point, vec3s to_sun);

/* Returns the share of light that is turned by an angle, by that of even scattering. */
float cloud_phase(const struct cloud *cloud, float cosine);

/* Returns a direction of scattered light for a random point of the unit square. */
vec3s cloud_turned(const struct cloud *cloud, vec3s dir, vec2s at);

#endif
