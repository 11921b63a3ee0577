/*
 * mesh.h: indexed triangles on the CPU, with the vertex layout of all passes.
 *
 * Space:     decided by the owner; the meshes of a scene are in world space (right-handed, +Y up,
 *            metres).
 * Winding:   counter-clockwise seen from outside.
 * Ownership: a mesh owns its arrays (malloc'd); mesh_finish() frees them.
 */
#ifndef FIRN_SCENE_MESH_H
#define FIRN_SCENE_MESH_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>
#include "shaders/mesh.h"

struct mesh_vertex {
    vec3s position;
    vec3s normal;      /* unit, outward */
    vec3s color;       /* linear Rec.709: vertex colour times base colour factor */
    vec2s uv;          /* (0, 0) is the texture's top left */
    uint32_t material; /* bits of shaders/mesh.h; the same at a triangle's three corners */
};

/* What few vertices have. */
struct mesh_extra {
    vec3s tangent; /* unit, along u; {0}: derived from the coordinates */
    float side;    /* of the bitangent, which is against v: cross(normal, tangent) * side; 1, -1 or,
                      without a tangent, 0 */
    vec2s uv;      /* a second set of texture coordinates */
};

struct mesh {
    struct mesh_vertex *vertices;
    struct mesh_extra *extras; /* of each vertex; NULL: none has any */
    uint32_t *indices;         /* three per triangle */
    uint32_t vertex_count;
    uint32_t index_count;
};

/* Axis-aligned box. An empty mesh's box is {0}. */
struct box {
    vec3s min, max;
};

/*
 * Allocates arrays of the given counts, all zero. Returns false when out of memory or if the sizes
 * overflow; *mesh is then {0}.
 */
bool mesh_init(struct mesh *mesh, uint32_t vertex_count, uint32_t index_count);

/* Allocates the vertices' extras, all zero, unless they are there. Returns false when out of
 * memory. */
bool mesh_add_extras(struct mesh *mesh);

/* Frees the arrays and leaves *mesh {0}. A {0} mesh is fine. */
void mesh_finish(struct mesh *mesh);

/* Appends a copy of `other`, which must be another mesh. Returns false when out of memory or if the
 * counts overflow; *mesh is then unchanged. */
bool mesh_append(struct mesh *mesh, const struct mesh *other);

/* Returns how many rows of MESH_EXTRA_WIDTH texels the extras of vertices are. */
static inline uint32_t mesh_extra_row_count(uint32_t vertex_count)
{
    return (vertex_count + MESH_EXTRA_WIDTH / MESH_EXTRA_TEXELS - 1) /
           (MESH_EXTRA_WIDTH / MESH_EXTRA_TEXELS);
}

struct box mesh_box(const struct mesh *mesh);

vec3s box_center(struct box box);

/* Returns whether `inner` is within `outer`, or touches it from inside. */
bool box_contains(const struct box *outer, const struct box *inner);

/* Returns the length of the diagonal. */
float box_diagonal(struct box box);

/* Moves the box's centre to the origin and scales uniformly to a width of `width` along x, where
 * the box must have an extent. Normals are unchanged. */
void mesh_fit(struct mesh *mesh, float width);

/*
 * Sets every vertex normal to the mean of its triangles' normals weighted by their angles there,
 * which does not depend on the triangulation of a surface (Thuermer and Wuethrich 1998).
 * Vertices of no triangle with an area get +Y.
 */
void mesh_make_normals(struct mesh *mesh);

/*
 * Returns whether the mesh is closed and no vertex is outside of any triangle's plane, to a hundred
 * thousandth of the size: a ray is then inside in one interval at most. Returns false without a
 * test for more than MESH_CONVEX_MAX pairs of a triangle and a vertex.
 */
#define MESH_CONVEX_MAX (1u << 24)
bool mesh_is_convex(const struct mesh *mesh);

/* Where each of the first triangles of a mesh was before they were sorted. */
struct mesh_order {
    uint32_t *all;
    uint32_t count;
};

/*
 * Sorts the triangles by distance from a point, nearest first, so that a depth test rejects most
 * fragments that are hidden from there. Distances are quantised to shells, each less than a quarter
 * larger than the last, in which the order is kept, for vertex caches. *order, unless it is NULL,
 * gets an array that the caller frees. Returns false when out of memory; *mesh is then unchanged,
 * and *order is {0}.
 */
bool mesh_sort_by_distance(struct mesh *mesh, vec3s from, struct mesh_order *order);

#endif
