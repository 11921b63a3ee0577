/* tree_nodes.h: the nodes of a part's tree in the words of shaders/tree.h. */
#ifndef FIRN_SCENE_TREE_NODES_H
#define FIRN_SCENE_TREE_NODES_H

#include "src/scene/tree_shape.h"

/* Returns how many words the nodes of a part that has triangles take. */
uint32_t tree_nodes_count(const struct tree_shape *shape);

/* Writes the nodes of a part behind those that the tree has, and returns the root. The part's maps
 * have been written, `first` being its first triangle. `has_cones`: normals are written, too. */
uint32_t tree_nodes_lay(struct tree *tree, const struct tree_shape *shape, uint32_t first,
                        bool has_cones);

#endif
