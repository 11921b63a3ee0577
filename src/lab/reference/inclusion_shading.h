/*
 * inclusion_shading.h: cracks, textured planes of air, bumps and frost for the path tracer. Noise
 * and formulas are as in shaders/inclusions/cracks_noise.h and shaders/lighting/bump_normal.h.
 */
#ifndef FIRN_LAB_REFERENCE_INCLUSION_SHADING_H
#define FIRN_LAB_REFERENCE_INCLUSION_SHADING_H

#include "shaders/inclusions/air_planes.h"
#include "src/lab/reference/embree_scene.h"
#include "src/settings/settings.h"

struct inclusions {
    const struct radiance *radiance; /* borrowed */
    mat3s world_from_object;         /* rotation of the object */
    float crack_rms_slope;           /* RMS slope of crack surfaces */
    float crack_gap;                 /* maximum gap of a crack, micrometres */
    bool is_uneven;                  /* the surface has bumps or frost */
    bool has_bumps;                  /* bump map with nonzero strength */
    bool is_mapped_by_uv;            /* uv bump mapping instead of triplanar */
    float frost;                     /* frost amount; 0 without frost map */
    float frost_roughness;
    struct air_push air; /* opacities of planes of air */
    vec3s air_light;     /* radiance of planes of air */
};

struct inclusions inclusions_of(const struct radiance *radiance, const struct settings *settings);

/* Returns the normal of a rough crack, on the same side as the normal of its mesh. */
vec3s inclusions_crack_normal(const struct inclusions *inclusions,
                              const struct mesh_vertex *surface);

/* Returns the opacity of a plane of air at a point for a ray of unit direction `dir`. */
float inclusions_air_cover(const struct inclusions *inclusions, const struct mesh_vertex *surface,
                           vec3s dir);

struct inclusions_surface {
    vec3s normal; /* outward bumped normal, before bump_facing() */
    float frost;  /* frost coverage, 0 to 1 */
};

/* Evaluates bumps and frost at a hit. `normal` is the outward unit normal in world space. */
struct inclusions_surface inclusions_surface_at(const struct inclusions *inclusions,
                                                const struct embree_scene *embree_scene,
                                                const struct embree_scene_hit *hit, vec3s normal);

#endif
