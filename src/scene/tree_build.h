/* tree_build.h: how tree.c finds the boxes of a tree, before their layout. */
#ifndef FIRN_SCENE_TREE_BUILD_H
#define FIRN_SCENE_TREE_BUILD_H

#include <stdint.h>
#include "shaders/tree.h"

enum {
    TREE_LEAF_MAX = 4, /* triangles of a leaf */
};

struct tree_box {
    float low[3], high[3];
};

/* A node of n triangles is followed by those of its first child, whose place is the next one, and
 * of its second: 2 n - 1 places are enough for all of them. */
struct tree_node {
    struct tree_box box;
    uint32_t first, count; /* triangles in `order` */
    uint32_t second;       /* place of the second child; 0: a leaf */
};

struct tree_draft {
    struct tree_box *boxes;  /* of the triangles */
    uint32_t *order;         /* triangles, in the order of the leaves */
    struct tree_node *nodes; /* the first one is the root */
    uint32_t count;          /* triangles */
};

/* Fills nodes and order, whose content may be any order. */
void tree_build(struct tree_draft *draft, uint32_t threads);

#endif
