/*
 * tree_horizon.h: how high above a triangle's plane other triangles are seen from it.
 *
 * A ray that leaves a triangle's outer side steeper than its horizon meets none of the part's
 * triangles, and needs not be followed through the tree (horizon angles: Max 1988, Horizon mapping;
 * here one for all directions around). Horizons are upper bounds, but for what rises by no more
 * than the rounding of places.
 */
#ifndef FIRN_SCENE_TREE_HORIZON_H
#define FIRN_SCENE_TREE_HORIZON_H

#include "src/scene/tree_part.h"

enum {
    TREE_HORIZON_MAX = 1 << 16, /* triangles of a part whose horizons are sought */
};

/* Returns, in the order of a shape's leaves, the sine of each triangle's horizon in steps of
 * 1 / TREE_HORIZON_STEPS, rounded up, or TREE_HORIZON_UNKNOWN. The caller frees them. Returns NULL
 * for a part with too many triangles, or when out of memory: all are unknown. Those of triangles
 * that would take long are, too. */
uint8_t *tree_horizons(const struct tree_shape *shape, const struct tree_part *part,
                       uint32_t threads);

/* Whether a tree has the grid of shaders/tree.h: rays begin on a single object, whose horizons are
 * known. */
bool tree_has_grid(const struct tree *tree, const struct tree_shape *objects);

/* Writes the grid to the next words of the corners, which have room for it. */
void tree_grid_lay(struct tree *tree, const struct tree_shape *objects,
                   const struct tree_part *part);

#endif
