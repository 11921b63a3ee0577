/*
 * tree_shape.h: the tree of a part while it is built: a tree for each group of triangles, and one
 * of those.
 *
 * Where groups move, their trees keep their shapes, which are those of the model at rest, and only
 * their boxes change. So a pose has the same tree whatever poses have been before it.
 */
#ifndef FIRN_SCENE_TREE_SHAPE_H
#define FIRN_SCENE_TREE_SHAPE_H

#include "src/scene/tree_part.h"

/* What has been done. */
struct tree_work {
    uint32_t threads;
    double growth_max;              /* of a tree's cost, before a new one is built */
    bool is_cached;                 /* large trees are read from files, and written to them */
    uint32_t built, shared, fitted; /* groups whose tree is new, that of an alike one, kept */
    uint32_t read;                  /* those whose tree is from a file */
};

/* Makes the tree of a part; one that is cached has no bubbles. Returns false when out of memory. */
MUST_USE bool tree_shape_make(struct tree_shape *shape, const struct tree_part *part,
                              struct tree_work *work);

/*
 * Makes the tree of a part from its shape at rest. Groups that are moved, turned or scaled evenly
 * keep theirs; of others those are built anew whose rays cost more than work->growth_max times as
 * much as at rest, or all if the groups are not those at rest. Returns false when out of memory.
 */
MUST_USE bool tree_shape_pose(struct tree_shape *shape, const struct tree_part *part,
                              const struct tree_shape *rest, const struct tree_part *rest_part,
                              struct tree_work *work);

/* Gives back the memory of nodes that a shape does not need, which then has groups, but no tree of
 * them. Returns false when out of memory. */
MUST_USE bool tree_shape_pack(struct tree_shape *shape);

void tree_shape_finish(struct tree_shape *shape);

#endif
