/*
 * inclusions.h: what the rasteriser draws in and on ice, as the reference meets it: cracks, planes
 * of air, bumps, frost.
 *
 * Fields and formulas are those of the shaders (shaders/cracks_noise.h, shaders/bump_normal.h).
 * Maps are filtered bilinearly, without mip levels.
 */
#ifndef FIRN_REFERENCE_INCLUSIONS_H
#define FIRN_REFERENCE_INCLUSIONS_H

#include "shaders/air.h"
#include "src/reference/bvh.h"
#include "src/settings/settings.h"

struct inclusions {
    const struct radiance *radiance; /* borrowed */
    mat3s world_from_object;         /* its rotation */
    float crack_slope;               /* of the cracks' roughness; 0: smooth */
    float crack_gap;                 /* in their middle, micrometres */
    bool is_uneven;                  /* has bumps or frost, which inclusions_surface_at() tells */
    bool has_bumps;                  /* with a map */
    bool is_mapped_by_uv;            /* the map, by the mesh's uv */
    float frost;                     /* amount; 0: none, or there is no map */
    float frost_roughness;
    struct air_push air; /* opacities of the planes of air */
    vec3s air_light;     /* radiance of the planes of air */
};

struct inclusions inclusions_of(const struct radiance *radiance, const struct settings *settings);

/* Returns the normal of a crack, with its roughness, on the side of its mesh's. */
vec3s inclusions_crack_normal(const struct inclusions *inclusions,
                              const struct mesh_vertex *surface);

/* Returns the opacity of a plane of air that a ray along `dir` meets. */
float inclusions_air_cover(const struct inclusions *inclusions, const struct mesh_vertex *surface,
                           vec3s dir);

/* What the map says of a point of the object. */
struct inclusions_surface {
    vec3s normal; /* outward, with bumps: bump_facing() is still to be called */
    float frost;  /* share of the surface that is covered by crystals, 0 to 1 */
};

/* `normal` is the smooth one, unit, outward, in the world; `hit` is one of the object. */
struct inclusions_surface inclusions_surface_at(const struct inclusions *inclusions,
                                                const struct bvh *bvh, const struct bvh_hit *hit,
                                                vec3s normal);

#endif
