/* tree_nodes.h: the words of a tree's nodes (shaders/tree.h). */
#ifndef FIRN_SCENE_TREE_NODES_H
#define FIRN_SCENE_TREE_NODES_H

#include "src/scene/tree_shape.h"

/* Returns how many words the nodes of a part and its grid take; it has triangles. */
uint32_t tree_nodes_count(const struct tree_shape *shape);

/* Lays out the nodes of a part whose triangles have been laid out, from `first` on, and returns its
 * root. Cones leave fewer bits for planes. */
uint32_t tree_nodes_lay(struct tree *tree, const struct tree_shape *shape, uint32_t first,
                        bool has_cones);

/* Returns the box of a child in a grid's coordinates, from the grid's words and the child's. */
struct tree_box tree_nodes_box(const uint32_t grid[static TREE_NODE_WORDS][4],
                               const uint32_t child[static 4]);

/* Returns the box that a part's grid has room for. */
struct tree_box tree_nodes_extent(const struct tree *tree, uint32_t part);

#endif
