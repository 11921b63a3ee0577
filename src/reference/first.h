/* first.h: the layers of the first surface that a ray from the eye meets. */
#ifndef FIRN_REFERENCE_FIRST_H
#define FIRN_REFERENCE_FIRST_H

#include "shaders/first_surface.h"
#include "src/reference/bvh.h"
#include "src/reference/reference_layers.h"

struct first {
    const struct bvh *bvh;
    const struct radiance *radiance;
    const struct first_surface_earlier *earlier; /* may be NULL: nothing moves */
};

/* Fills the layers of the first surface, as gbuffer.c and first_surface.c draw them: behind `met`
 * where that is a blended surface with an alpha below one half. `forward` is the view's axis. */
void first_look(const struct first *first, const struct bvh_ray *ray, vec3s forward,
                const struct bvh_hit *met, struct reference_seen *seen);

/* Returns the number, as in the layer `object`, of the object of what a ray has met: BVH_OBJECT or
 * BVH_SURROUNDINGS. */
float first_number(const struct first *first, const struct bvh_hit *hit);

#endif
