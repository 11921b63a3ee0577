/*
 * inclusions.h: cracks, planes of air, bumps and frost for the path tracer.
 *
 * The noise functions and formulas are shared with the shaders (shaders/inclusions/cracks_noise.h,
 * shaders/lighting/bump_normal.h). Maps are filtered bilinearly, without mip levels.
 */
#ifndef FIRN_REFERENCE_INCLUSIONS_H
#define FIRN_REFERENCE_INCLUSIONS_H

#include "shaders/inclusions/air.h"
#include "src/reference/embree_scene.h"
#include "src/settings/settings.h"

struct inclusions {
    const struct radiance *radiance; /* borrowed */
    mat3s world_from_object;         /* rotation of the object */
    float crack_rms_slope;           /* roughness of crack surfaces; 0 if they are smooth */
    float crack_gap;                 /* gap width at the middle of a crack, micrometres */
    bool is_uneven; /* the surface has bumps or frost, so inclusions_surface_at() must be called */
    bool has_bumps; /* there is a bump map with a strength above 0 */
    bool is_mapped_by_uv; /* the bump map uses the mesh's uv, else triplanar mapping */
    float frost;          /* amount of frost; 0 if there is none, or no map */
    float frost_roughness;
    struct air_push air; /* opacities of planes of air */
    vec3s air_light;     /* radiance of planes of air */
};

struct inclusions inclusions_of(const struct radiance *radiance, const struct settings *settings);

/* Returns the normal of a crack, perturbed by its roughness, on the same side as the mesh's normal.
 */
vec3s inclusions_crack_normal(const struct inclusions *inclusions,
                              const struct mesh_vertex *surface);

/* Returns the opacity of a plane of air for a ray with direction `dir`. */
float inclusions_air_cover(const struct inclusions *inclusions, const struct mesh_vertex *surface,
                           vec3s dir);

/* Surface properties from the bump and frost maps. */
struct inclusions_surface {
    vec3s normal; /* outward, with bumps; the caller still applies bump_facing() */
    float frost;  /* fraction of the surface that frost crystals cover, 0 to 1 */
};

/* Evaluates bumps and frost at a hit on the object; `normal` is unit, outward, in world space. */
struct inclusions_surface inclusions_surface_at(const struct inclusions *inclusions,
                                                const struct embree_scene *embree_scene,
                                                const struct embree_scene_hit *hit, vec3s normal);

#endif
