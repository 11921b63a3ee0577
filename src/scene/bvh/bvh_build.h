/* bvh_build.h: BVH construction, refitting and SAH cost, before the nodes are encoded. */
#ifndef FIRN_SCENE_BVH_BVH_BUILD_H
#define FIRN_SCENE_BVH_BVH_BUILD_H

#include <stdint.h>
#include "shaders/trace/bvh_layout.h"

enum {
    BVH_LEAF_MAX = 4,   /* triangles per leaf */
    BVH_BIN_COUNT = 16, /* bins along each axis */
};

/* SAH cost of visiting a node, in ray-triangle tests. */
#define BVH_NODE_COST 1.2f

struct bvh_box {
    float low[3], high[3];
};

struct bvh_node {
    struct bvh_box box;
    uint32_t first, count; /* range of triangles in `order` */
    uint32_t children[2];  /* node indices; 0 for a leaf */
};

struct bvh_builder {
    struct bvh_box *boxes; /* bounding box of each triangle */
    uint32_t *order;       /* triangle indices in leaf order */
    /* node pool; a subtree of n triangles uses at most 2 n - 1 slots, starting at its root */
    struct bvh_node *nodes;
    uint32_t leaf_max; /* triangles per leaf */
};

/* Range of triangles in bvh_builder.order that has its own BVH. */
struct bvh_range {
    uint32_t first, count; /* count is above 0 */
    uint32_t root;
};

/* Two-level BVH of a scene part (bvh_two_level.h), before encoding. */
struct bvh_two_level {
    struct bvh_builder builder; /* without boxes after the build */
    struct bvh_range *groups;
    uint32_t count, group_count; /* numbers of triangles and groups */
    uint32_t node_count;         /* size of the node array */
    uint32_t root;               /* node index of the part's root */
    uint32_t depth;              /* maximum depth within a group */
};

/* Returns the depth of a balanced BVH of `count` triangles. */
uint32_t bvh_balanced_depth(uint32_t count, uint32_t leaf_max);

/* Builds a range's BVH, at most `left` levels deep. `left` must exceed bvh_balanced_depth(). */
void bvh_build(struct bvh_builder *builder, const struct bvh_range *range, uint32_t left,
               uint32_t threads);

/* Refits the boxes of the subtree at node `at` to its triangles, bottom-up. */
void bvh_refit(struct bvh_builder *builder, uint32_t at);

/* Returns the SAH cost of a subtree for rays that hit its box, in ray-triangle tests. */
double bvh_sah_cost(const struct bvh_builder *builder, uint32_t at);

#endif
