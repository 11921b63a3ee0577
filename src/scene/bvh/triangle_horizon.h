/*
 * triangle_horizon.h: horizon angles of triangles, above which rays leave an object unoccluded.
 *
 * As in horizon mapping (Max 1988), but with one angle for all azimuths. A ray that leaves a
 * triangle's outer side more steeply than its horizon hits nothing of the same scene part and needs
 * no BVH traversal. Horizons are conservative up to the rounding of positions. They cost 4 bits per
 * triangle, and are computed once at build time.
 */
#ifndef FIRN_SCENE_BVH_TRIANGLE_HORIZON_H
#define FIRN_SCENE_BVH_TRIANGLE_HORIZON_H

#include "src/scene/bvh/bvh_scene_parts.h"

enum {
    BVH_HORIZON_TRIANGLES_MAX = 1 << 16, /* maximum triangle count of a part with horizons */
};

/* Computes the sine of each triangle's horizon angle, in leaf order. Sines are rounded up to steps
 * of 1 / BVH_HORIZON_STEPS. If a search takes too long, the value is BVH_HORIZON_UNKNOWN. The
 * caller frees the array. Returns NULL if the part has too many triangles, or when out of memory.
 */
uint8_t *bvh_horizons_compute(const struct bvh_two_level *hierarchy, const struct bvh_part *part,
                              uint32_t threads);

/* Returns true if the BVH gets a horizon grid, which requires a single object with horizons. */
bool bvh_has_horizon_grid(const struct bvh *bvh, const struct bvh_two_level *objects);

/* Writes the horizon grid (shaders/trace/bvh_layout.h) to the reserved end of the corner array. */
void bvh_horizon_grid_write(struct bvh *bvh, const struct bvh_two_level *objects,
                            const struct bvh_part *part);

#endif
