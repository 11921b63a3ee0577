/* bvh_scene_parts.h: grouped triangle lists of a scene's parts (shaders/trace/bvh_layout.h). */
#ifndef FIRN_SCENE_BVH_BVH_SCENE_PARTS_H
#define FIRN_SCENE_BVH_BVH_SCENE_PARTS_H

#include "src/scene/bvh/bvh.h"
#include "src/scene/bvh/bvh_build.h"

struct bvh_part {
    const struct model *model;
    const struct mesh *mesh;                  /* NULL for none */
    const struct bubbles *bubbles;            /* numbered after the triangles; or NULL */
    const struct coincident_shells *contacts; /* NULL for none */
    uint32_t *triangles;                      /* mesh triangle indices in file order */
    uint32_t count;
    uint32_t *firsts; /* start of each group in `triangles`, followed by `count` */
    uint32_t group_count;
    bool is_object, is_inclusion;
};

/* Lists the triangles of all parts. Each object is a group if `by_objects` is true, otherwise each
 * part. If out of memory, returns false. Even then, call bvh_parts_finish(). */
MUST_USE bool bvh_parts_init(struct bvh_part parts[static BVH_COUNT],
                             const struct bvh_params *params, bool by_objects);
void bvh_parts_finish(struct bvh_part parts[static BVH_COUNT]);

/* Returns the bubble with a triangle number, or NULL if a mesh triangle has this number. */
const struct bubble *bvh_bubble(const struct bvh_part *part, uint32_t triangle);

const struct mesh_vertex *bvh_corner(const struct bvh_part *part, uint32_t triangle, uint32_t k);

struct bvh_box bvh_triangle_box(const struct bvh_part *part, uint32_t triangle);

/* Returns true if the objects' box overlaps no bounding box of a surroundings triangle. If
 * `rotates`, the box contains all rotations about +Y, and moving surroundings count as overlap. */
bool bvh_parts_are_disjoint(const struct bvh_part parts[static BVH_COUNT], bool rotates);

/* Returns true if each edge of the mesh has an opposite edge. */
bool bvh_part_is_closed(const struct bvh_part *part);

#endif
