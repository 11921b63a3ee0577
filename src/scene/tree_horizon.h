/*
 * tree_horizon.h: horizon angles of triangles, above which rays leave an object unoccluded.
 *
 * As in horizon mapping (Max 1988), but one angle for all azimuths. A ray that leaves a triangle's
 * outer side more steeply than its horizon hits nothing of the same part and needs no BVH
 * traversal. Horizons are conservative up to the rounding of positions. They cost 4 bits per
 * triangle, and are computed once at build time.
 */
#ifndef FIRN_SCENE_TREE_HORIZON_H
#define FIRN_SCENE_TREE_HORIZON_H

#include "src/scene/tree_part.h"

enum {
    TREE_HORIZON_MAX = 1 << 16, /* maximum triangle count of a part with horizons */
};

/* Returns the sine of each triangle's horizon in leaf order, in steps of 1 / TREE_HORIZON_STEPS,
 * rounded up, or TREE_HORIZON_UNKNOWN where the search would take too long. The caller frees the
 * array. Returns NULL for a part with too many triangles or when out of memory. */
uint8_t *tree_horizons(const struct tree_shape *shape, const struct tree_part *part,
                       uint32_t threads);

/* Returns true if the BVH has a horizon grid (shaders/tree.h): a single object with known horizons.
 */
bool tree_has_grid(const struct tree *tree, const struct tree_shape *objects);

/* Writes the horizon grid to the reserved end of the corner array. */
void tree_grid_lay(struct tree *tree, const struct tree_shape *objects,
                   const struct tree_part *part);

#endif
