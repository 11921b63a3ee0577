/* tree_build.h: how trees of triangles find their boxes, before their layout. */
#ifndef FIRN_SCENE_TREE_BUILD_H
#define FIRN_SCENE_TREE_BUILD_H

#include <stdint.h>
#include "shaders/tree.h"

enum {
    TREE_LEAF_MAX = 4,   /* triangles of a leaf */
    TREE_BIN_COUNT = 16, /* between which triangles are parted, along each axis */
};

/* Cost of a node, in tests of a triangle. */
#define TREE_NODE_COST 1.2f

struct tree_box {
    float low[3], high[3];
};

struct tree_node {
    struct tree_box box;
    uint32_t first, count; /* triangles in `order` */
    uint32_t children[2];  /* places; 0: a leaf */
};

struct tree_draft {
    struct tree_box *boxes; /* of the triangles */
    uint32_t *order;        /* triangles, in the order of the leaves */
    struct tree_node
        *nodes;        /* those of n triangles take at most 2 n - 1 places from their root on */
    uint32_t leaf_max; /* triangles of a leaf */
};

/* Triangles in `order` that have a tree of their own, and the place of its root. */
struct tree_range {
    uint32_t first, count; /* not 0 */
    uint32_t root;
};

/* The tree of a part (tree_shape.h). */
struct tree_shape {
    struct tree_draft draft; /* of a finished shape, without boxes */
    struct tree_range *groups;
    uint32_t count, group_count; /* triangles; groups */
    uint32_t node_count;         /* places of nodes */
    uint32_t root;               /* of the whole part */
    uint32_t depth;              /* nodes that a way within a group may have */
    uint8_t *horizons;           /* of its triangles: tree_horizon.h; NULL: they are unknown */
};

/* Returns how many nodes a way has to a leaf if each node halves its triangles. */
uint32_t tree_levels(uint32_t count, uint32_t leaf_max);

/* Fills the nodes and the order of a range, which may be any; ways have at most `left` nodes, which
 * are more than tree_levels(). */
void tree_build(struct tree_draft *draft, const struct tree_range *range, uint32_t left,
                uint32_t threads);

/* Fits the boxes of the nodes at a place and below to those of the triangles. */
void tree_refit(struct tree_draft *draft, uint32_t at);

/* Returns the cost of a ray through the nodes at a place and below, in tests of triangles, if it
 * meets the first box (surface area heuristic). */
double tree_cost(const struct tree_draft *draft, uint32_t at);

#endif
