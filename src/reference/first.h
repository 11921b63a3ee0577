/* first.h: layers (AOVs) of the primary hit of a camera ray. */
#ifndef FIRN_REFERENCE_FIRST_H
#define FIRN_REFERENCE_FIRST_H

#include "shaders/first_surface.h"
#include "src/reference/bvh.h"
#include "src/reference/reference_layers.h"

struct primary_hit_layers {
    const struct bvh *bvh;
    const struct radiance *radiance;
    const struct first_surface_earlier *earlier; /* previous frame; NULL if nothing moves */
};

/* Fills the layers of the primary hit, with the same rules as gbuffer.c and first_surface.c:
 * blended surfaces with an alpha below one half are skipped. `met` is the closest hit of the ray;
 * `forward` is the viewing direction. */
void first_look(const struct primary_hit_layers *first, const struct bvh_ray *ray, vec3s forward,
                const struct bvh_hit *met, struct reference_seen *seen);

/* Returns the object number of a hit on BVH_OBJECT or BVH_SURROUNDINGS, as in the layer `object`.
 */
float first_number(const struct primary_hit_layers *first, const struct bvh_hit *hit);

#endif
