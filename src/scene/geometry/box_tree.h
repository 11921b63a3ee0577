/* box_tree.h: bounding volume hierarchy of boxes, to find those that overlap another box. */
#ifndef FIRN_SCENE_GEOMETRY_BOX_TREE_H
#define FIRN_SCENE_GEOMETRY_BOX_TREE_H

#include "src/scene/bvh/bvh_build.h"
#include "src/scene/geometry/mesh.h"

/* {0} is an empty tree. */
struct box_tree {
    struct bvh_builder bvh;
    uint32_t count;
};

/* Builds a tree of `count` boxes. Returns false when out of memory; *tree is then empty. */
bool box_tree_init(struct box_tree *tree, const struct box *boxes, uint32_t count);
void box_tree_finish(struct box_tree *tree);

/* Calls `visit` with the index of each box that overlaps or touches `box`, until it returns false.
 */
void box_tree_visit(const struct box_tree *tree, const struct box *box, void *user,
                    bool (*visit)(void *user, uint32_t index));

#endif
