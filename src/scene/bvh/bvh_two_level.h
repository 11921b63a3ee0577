/*
 * bvh_two_level.h: builds two-level BVHs: one BVH per object, and a top-level BVH over the objects.
 * Moving objects keep the BVH topology of the rest pose. Their boxes are always refitted from the
 * rest pose, because a pose's BVH must not depend on earlier poses.
 */
#ifndef FIRN_SCENE_BVH_BVH_TWO_LEVEL_H
#define FIRN_SCENE_BVH_BVH_TWO_LEVEL_H

#include "src/scene/bvh/bvh_scene_parts.h"

/* Options and statistics of BVH builds. */
struct bvh_build_stats {
    uint32_t threads;
    double cost_growth_max; /* factor of SAH cost growth above which a BVH is rebuilt */
    bool is_cached;         /* store large BVHs in cache files */
    /* numbers of groups that were built, copied from similar groups, or refitted */
    uint32_t built, shared, refitted;
    uint32_t read; /* number of groups loaded from the cache */
};

/* Builds a part's BVH. Parts with bubbles must not be cached. Returns false when out of memory. */
MUST_USE bool bvh_two_level_build(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                                  struct bvh_build_stats *work);

/* Builds the BVH of a pose by refitting the BVH of the rest pose. If a group is deformed and its
 * SAH cost grows by more than work->cost_growth_max, rebuilds the group. If the groups' triangle
 * ranges differ from the rest pose, rebuilds all groups. Returns false when out of memory. */
MUST_USE bool bvh_two_level_refit(struct bvh_two_level *hierarchy, const struct bvh_part *part,
                                  const struct bvh_two_level *rest,
                                  const struct bvh_part *rest_part, struct bvh_build_stats *work);

/* Discards unused nodes and the top-level BVH. Returns false when out of memory. */
MUST_USE bool bvh_two_level_pack(struct bvh_two_level *hierarchy);

void bvh_two_level_finish(struct bvh_two_level *hierarchy);

#endif
