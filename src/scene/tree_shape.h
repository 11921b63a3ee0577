/*
 * tree_shape.h: two-level BVH: one BVH per object, and a top-level BVH over their roots.
 *
 * Moving objects keep the topology of the rest pose; only boxes are refitted. The BVH of a pose
 * therefore does not depend on the poses before it.
 */
#ifndef FIRN_SCENE_TREE_SHAPE_H
#define FIRN_SCENE_TREE_SHAPE_H

#include "src/scene/tree_part.h"

/* Options and statistics of BVH builds. */
struct tree_work {
    uint32_t threads;
    double growth_max;              /* cost ratio to the rest pose above which a BVH is rebuilt */
    bool is_cached;                 /* large BVHs are read from and written to cache files */
    uint32_t built, shared, fitted; /* groups whose BVH was built, copied, or refitted */
    uint32_t read;                  /* groups whose BVH was loaded from the cache */
};

/* Builds a part's BVH; a cached part must have no bubbles. Returns false when out of memory. */
MUST_USE bool tree_shape_make(struct tree_shape *shape, const struct tree_part *part,
                              struct tree_work *work);

/*
 * Builds the BVH of a pose from the topology of the rest pose. Groups are refitted, unless they
 * have deformed and cost more than work->growth_max times the rest pose; those are rebuilt, and all
 * are if the groups differ. Returns false when out of memory.
 */
MUST_USE bool tree_shape_pose(struct tree_shape *shape, const struct tree_part *part,
                              const struct tree_shape *rest, const struct tree_part *rest_part,
                              struct tree_work *work);

/* Frees unused nodes, and drops the top-level BVH. Returns false when out of memory. */
MUST_USE bool tree_shape_pack(struct tree_shape *shape);

void tree_shape_finish(struct tree_shape *shape);

#endif
