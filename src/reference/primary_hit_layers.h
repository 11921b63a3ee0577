/* primary_hit_layers.h: layers (AOVs) of the primary hit of a camera ray. */
#ifndef FIRN_REFERENCE_PRIMARY_HIT_LAYERS_H
#define FIRN_REFERENCE_PRIMARY_HIT_LAYERS_H

#include "shaders/output/first_surface.h"
#include "src/reference/embree_scene.h"
#include "src/reference/reference_layers.h"

struct primary_hit_layers {
    const struct embree_scene *embree_scene;
    const struct radiance *radiance;
    const struct first_surface_previous *earlier; /* previous frame; NULL if nothing moves */
};

/* Fills the layers of the primary hit, with the same rules as gbuffer.c and first_surface.c:
 * blended surfaces with an alpha below one half are skipped. `met` is the closest hit of the ray;
 * `forward` is the viewing direction. */
void primary_hit_layers_fill(const struct primary_hit_layers *first,
                             const struct embree_scene_ray *ray, vec3s forward,
                             const struct embree_scene_hit *met, struct reference_ray_values *seen);

/* Returns the object number of a hit on EMBREE_SCENE_OBJECT or EMBREE_SCENE_SURROUNDINGS, as in the
 * layer `object`. */
float primary_hit_layers_object(const struct primary_hit_layers *first,
                                const struct embree_scene_hit *hit);

#endif
