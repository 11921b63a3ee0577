/* object.h: the refractive objects of a scene, and which medium is where they overlap. */
#ifndef FIRN_SCENE_OBJECT_H
#define FIRN_SCENE_OBJECT_H

#include "src/base/status.h"
#include "src/scene/material.h"
#include "src/scene/mesh.h"

/*
 * A shell that bounds a medium: a node of a model file with a transmissive material. Its triangles
 * are a range of the mesh of all objects.
 */
struct object {
    char name[MATERIAL_NAME_SIZE]; /* of the node; "" if it has none */
    uint32_t first_index, index_count;
    uint32_t material; /* index into the materials */
    struct box box;    /* of its triangles; set with the rank */
    uint32_t rank;     /* where shells overlap, the medium of the greatest rank is there; no two
                          objects have the same, and none has 0, the outside's */
    uint32_t holder;   /* rank of the innermost shell that all of this one is inside; 0: none */
    uint32_t within;   /* 1 + index of the innermost object all around this one, which may be in a
                          cavity of it; 0: none */
};

/* Returns a mesh that borrows all vertices, and the object's triangles, of the mesh of all
 * objects. */
struct mesh object_part(const struct object *object, const struct mesh *mesh);

/* Returns the box of an object's triangles. */
struct box object_box(const struct object *object, const struct mesh *mesh);

/*
 * Gives the objects their boxes and ranks: a stated priority beats none, and a greater one a lesser
 * one; of others, a shell that lies inside another one beats it; otherwise, the later object does.
 * Logs and returns STATUS_TRY_AGAIN when out of memory.
 */
MUST_USE enum status object_rank_all(struct object *objects, uint32_t count,
                                     const struct mesh *mesh, const struct material *materials);

/* Returns the index of the object that is around `index` and within no other one. */
uint32_t object_outermost(const struct object *objects, uint32_t index);

/* Returns whether the area vectors of an object's triangles add up to nothing, as those of closed
 * shells do. */
bool object_is_closed(const struct object *object, const struct mesh *mesh);

/* Returns whether a point is inside a shell: whether its triangles, seen from there, show their
 * backs in most directions. */
bool object_contains(const struct object *object, const struct mesh *mesh, vec3s point);

/* Returns the object of a triangle, whose first index is `index`. */
const struct object *object_of_index(const struct object *objects, uint32_t count, uint32_t index);

#endif
