/*
 * cloud.h: air in the object as a medium that scatters light and absorbs none (air.model=medium).
 *
 * Its density is that of shaders/cloud.h; its extinction where it is densest is air.density by the
 * object's width. A free path is found by delta tracking (Woodcock 1965), which is exact for any
 * density below the greatest; directions are those of Henyey and Greenstein 1941.
 */
#ifndef FIRN_REFERENCE_CLOUD_H
#define FIRN_REFERENCE_CLOUD_H

#include "src/reference/radiance.h"
#include "src/settings/settings.h"

struct cloud {
    const struct depth_field *field; /* borrowed */
    mat4s object_from_world;
    float most;       /* greatest extinction, 1 / metre; 0: there is no cloud */
    float anisotropy; /* mean cosine of the angle by which light is turned */
};

struct cloud cloud_of(const struct radiance *radiance, const struct settings *settings);

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

/* Returns a direction of scattered light for a random point of the unit square. */
vec3s cloud_turned(const struct cloud *cloud, vec3s dir, vec2s at);

#endif
