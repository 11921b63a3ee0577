/*
 * bvh_two_level.h: two-level BVH: one BVH per object, and a top-level BVH over their roots.
 *
 * Moving objects keep the topology of the rest pose; only boxes are refitted. The BVH of a pose
 * therefore does not depend on the poses before it.
 */
#ifndef FIRN_SCENE_BVH_BVH_TWO_LEVEL_H
#define FIRN_SCENE_BVH_BVH_TWO_LEVEL_H

#include "src/scene/bvh/bvh_scene_parts.h"

/* Options and statistics of BVH builds. */
struct bvh_build_stats {
    uint32_t threads;
    double cost_growth_max;           /* cost ratio to the rest pose above which a BVH is rebuilt */
    bool is_cached;                   /* large BVHs are read from and written to cache files */
    uint32_t built, shared, refitted; /* groups whose BVH was built, copied, or refitted */
    uint32_t read;                    /* groups whose BVH was loaded from the cache */
};

/* Builds a part's BVH; a cached part must have no bubbles. Returns false when out of memory. */
MUST_USE bool bvh_two_level_build(struct bvh_two_level *shape, const struct bvh_part *part,
                                  struct bvh_build_stats *work);

/*
 * Builds the BVH of a pose from the topology of the rest pose. Groups are refitted, unless they
 * have deformed and cost more than work->cost_growth_max times the rest pose; those are rebuilt,
 * and all are if the groups differ. Returns false when out of memory.
 */
MUST_USE bool bvh_two_level_refit(struct bvh_two_level *shape, const struct bvh_part *part,
                                  const struct bvh_two_level *rest,
                                  const struct bvh_part *rest_part, struct bvh_build_stats *work);

/* Frees unused nodes, and drops the top-level BVH. Returns false when out of memory. */
MUST_USE bool bvh_two_level_pack(struct bvh_two_level *shape);

void bvh_two_level_finish(struct bvh_two_level *shape);

#endif
