/* tree_nodes.h: encodes BVH nodes for the GPU (shaders/tree.h). */
#ifndef FIRN_SCENE_TREE_NODES_H
#define FIRN_SCENE_TREE_NODES_H

#include "src/scene/tree_shape.h"

/* Returns the number of 16-byte words of a part's nodes and grid. The part must have triangles. */
uint32_t tree_nodes_count(const struct tree_shape *shape);

/* Encodes a part's nodes and returns the root's index. `first` is the BVH index of its first
 * triangle, which must have been written. Normal cones leave fewer bits for box planes. */
uint32_t tree_nodes_lay(struct tree *tree, const struct tree_shape *shape, uint32_t first,
                        bool has_cones);

/* Returns the dequantised bounding box of a child, from the grid's words and the child's. */
struct tree_box tree_nodes_box(const uint32_t grid[static TREE_NODE_WORDS][4],
                               const uint32_t child[static 4]);

/* Returns the largest box that a part's quantisation grid can represent. */
struct tree_box tree_nodes_extent(const struct tree *tree, uint32_t part);

#endif
