/* bvh_node_encoding.h: encodes BVH nodes for the GPU (shaders/trace/bvh_layout.h). */
#ifndef FIRN_SCENE_BVH_BVH_NODE_ENCODING_H
#define FIRN_SCENE_BVH_BVH_NODE_ENCODING_H

#include "src/scene/bvh/bvh_two_level.h"

/* Returns the number of 16-byte words for the nodes and quantisation grid of a non-empty part. */
uint32_t bvh_nodes_word_count(const struct bvh_two_level *hierarchy);

/* Encodes a part's nodes; returns the root's index. The part's triangles must already be encoded,
 * from index `first` on. If `has_cones` is true, normal cones use bits of the child boxes. */
uint32_t bvh_nodes_write(struct bvh *bvh, const struct bvh_two_level *hierarchy, uint32_t first,
                         bool has_cones);

/* Returns a child's dequantised bounding box. `grid` is the part's encoded quantisation grid. */
struct bvh_box bvh_nodes_child_box(const uint32_t grid[static BVH_NODE_WORDS][4],
                                   const uint32_t child[static 4]);

/* Returns the largest box that a part's quantisation grid can represent. */
struct bvh_box bvh_nodes_extent(const struct bvh *bvh, uint32_t part);

#endif
