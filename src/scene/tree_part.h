/*
 * tree_part.h: the triangles of a part of a scene (shaders/tree.h), by the objects that they are
 * of.
 */
#ifndef FIRN_SCENE_TREE_PART_H
#define FIRN_SCENE_TREE_PART_H

#include "src/scene/tree.h"
#include "src/scene/tree_build.h"

struct tree_part {
    const struct model *model;
    const struct mesh *mesh;       /* NULL: none */
    const struct bubbles *bubbles; /* NULL: none; they count as triangles after the mesh's */
    uint32_t *triangles;           /* of the mesh, in the order of the model's file */
    uint32_t count;
    uint32_t *firsts; /* of each group in `triangles`, and at the end `count` */
    uint32_t group_count;
    bool is_object, is_inclusion;
};

/* Lists the parts, with a group for each object if `by_objects`, else one. Returns false when out
 * of memory; the caller finishes the parts in any case. */
MUST_USE bool tree_parts_init(struct tree_part parts[static TREE_PART_COUNT],
                              const struct tree_params *params, bool by_objects);
void tree_parts_finish(struct tree_part parts[static TREE_PART_COUNT]);

/* Returns the bubble that a triangle of the mesh is, or NULL. */
const struct bubble *tree_bubble(const struct tree_part *part, uint32_t triangle);

const struct mesh_vertex *tree_corner(const struct tree_part *part, uint32_t triangle, uint32_t k);

struct tree_box tree_box_of(const struct tree_part *part, uint32_t triangle);

/* Returns whether no box around a triangle of the surroundings meets that around the objects, or,
 * if they `turn` about their vertical axis, that around all turns of it; things that move around
 * them meet it then. */
bool tree_parts_are_apart(const struct tree_part parts[static TREE_PART_COUNT], bool turn);

/* Returns whether each side of a triangle is that of another one, reversed. */
bool tree_part_is_closed(const struct tree_part *part);

#endif
