/* refractive_object.h: refractive objects of a scene, and ranks that decide which object fills an
 * overlap. */
#ifndef FIRN_SCENE_REFRACTIVE_OBJECT_H
#define FIRN_SCENE_REFRACTIVE_OBJECT_H

#include "src/base/status.h"
#include "src/scene/geometry/box_tree.h"
#include "src/scene/geometry/mesh.h"
#include "src/scene/material.h"

/* Refractive object: a model node with a transmissive material, whose closed surface bounds a
 * medium. The object's triangles are a range of the mesh of all objects. */
struct object {
    char name[MATERIAL_NAME_SIZE]; /* name of the node; "" if it is unnamed */
    uint32_t first_index, index_count;
    uint32_t material; /* index into the model's materials; of the first of several materials */
    uint32_t open_edge_count; /* number of edges around holes; 0 if its shells are closed */
    /* number of closed shells around the medium, without cavities; at least 2 if triangles share an
     * edge with more than one other. 0 if some surface is open or flat, and of thin walls. */
    uint32_t solid_count;
    struct box box; /* bounding box of the triangles; set with the rank */
    uint32_t rank;  /* unique medium priority, above 0; the highest rank fills an overlap */
    /* rank of the innermost object whose medium surrounds this object; 0 for none */
    uint32_t container_rank;
    uint32_t
        /* 1 + index of innermost object around this one (cavities count as inside); 0 for none */
        enclosing_object;
};

/* Returns a mesh of the object's triangles that borrows the arrays of the mesh of all objects. */
struct mesh object_mesh(const struct object *object, const struct mesh *mesh);

/* Returns the bounding box of an object's triangles. */
struct box object_box(const struct object *object, const struct mesh *mesh);

/* Builds a tree of the objects' boxes. Returns false when out of memory. */
bool object_boxes_init(struct box_tree *tree, const struct object *objects, uint32_t count);

/* Sets the boxes and medium priorities (ranks) of all objects. Ranks depend on priority in the file
 * (lowest if absent), then on the number of enclosing objects, then on the index. If objects
 * overlap too densely, logs a warning and ranks them by index. If out of memory, logs an error and
 * returns STATUS_TRY_AGAIN. */
MUST_USE enum status object_assign_ranks(struct object *objects, uint32_t count,
                                         const struct mesh *mesh, const struct material *materials);

/* Returns the index of the outermost object around object `index`, or `index` itself. */
uint32_t object_outermost(const struct object *objects, uint32_t index);

/* Returns true if a point is inside an object, by solid angles. Tolerates small holes. */
bool object_contains(const struct object *object, const struct mesh *mesh, vec3s point);

/* Returns the object that owns the triangle whose first index is `index`. */
const struct object *object_of_index(const struct object *objects, uint32_t count, uint32_t index);

#endif
