/*
 * inclusions.h: what the rasteriser draws in and on ice, as the reference meets it: cracks.
 *
 * Fields and formulas are those of the shaders (shaders/cracks_noise.h).
 */
#ifndef FIRN_REFERENCE_INCLUSIONS_H
#define FIRN_REFERENCE_INCLUSIONS_H

#include "src/reference/bvh.h"
#include "src/settings/settings.h"

struct inclusions {
    const struct radiance *radiance; /* borrowed */
    mat3s world_from_object;         /* its rotation */
    float crack_slope;               /* of the cracks' roughness; 0: smooth */
};

struct inclusions inclusions_of(const struct radiance *radiance, const struct settings *settings);

/* Returns the normal of a crack, with its roughness, on the side of its mesh's. */
vec3s inclusions_crack_normal(const struct inclusions *inclusions,
                              const struct mesh_vertex *surface);

#endif
