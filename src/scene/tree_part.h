/*
 * tree_part.h: triangle lists of the scene's parts (shaders/tree.h), grouped by object.
 */
#ifndef FIRN_SCENE_TREE_PART_H
#define FIRN_SCENE_TREE_PART_H

#include "src/scene/tree.h"
#include "src/scene/tree_build.h"

struct tree_part {
    const struct model *model;
    const struct mesh *mesh;       /* NULL for none */
    const struct bubbles *bubbles; /* NULL for none; numbered after the triangles */
    uint32_t *triangles;           /* mesh triangle indices in file order */
    uint32_t count;
    uint32_t *firsts; /* start of each group in `triangles`, and `count` as the last element */
    uint32_t group_count;
    bool is_object, is_inclusion;
};

/* Lists the triangles of all parts: one group per object if `by_objects`, else one group per part.
 * Returns false when out of memory; the caller must finish the parts in any case. */
MUST_USE bool tree_parts_init(struct tree_part parts[static TREE_PART_COUNT],
                              const struct tree_params *params, bool by_objects);
void tree_parts_finish(struct tree_part parts[static TREE_PART_COUNT]);

/* Returns the bubble with this triangle number, or NULL if it is a triangle of the mesh. */
const struct bubble *tree_bubble(const struct tree_part *part, uint32_t triangle);

const struct mesh_vertex *tree_corner(const struct tree_part *part, uint32_t triangle, uint32_t k);

struct tree_box tree_box_of(const struct tree_part *part, uint32_t triangle);

/* Returns true if no triangle's box in the surroundings overlaps the objects' box or, with `turn`,
 * its rotations about the vertical axis. With `turn`, moving surroundings count as overlapping. */
bool tree_parts_are_apart(const struct tree_part parts[static TREE_PART_COUNT], bool turn);

/* Returns true if each edge of the mesh has an opposite edge. */
bool tree_part_is_closed(const struct tree_part *part);

#endif
