/*
 * mesh.h: defines an indexed triangle mesh, whose vertex layout all passes use. The meshes of a
 * scene are in world space (right-handed, +Y up, metres). Triangles are counter-clockwise when seen
 * from outside. mesh_finish() frees the malloc'd arrays.
 */
#ifndef FIRN_SCENE_GEOMETRY_MESH_H
#define FIRN_SCENE_GEOMETRY_MESH_H

#include <cglm/types-struct.h>
#include <stdbool.h>
#include <stdint.h>
#include "shaders/mesh_layout.h"

struct mesh_vertex {
    vec3s position;
    vec3s normal; /* unit outward normal */
    vec3s color;  /* linear Rec.709 vertex colour, times base colour factor */
    vec2s uv;     /* texture coordinates; (0, 0) is the texture's top left */
    /* material bits of shaders/mesh_layout.h, equal at a triangle's three corners */
    uint32_t material;
};

/* Optional attributes, which few meshes have. */
struct mesh_extra {
    vec3s tangent; /* unit tangent along u; zero to derive it from texture coordinates */
    float side;    /* 1, -1 or 0; cross(normal, tangent) * side is the bitangent, opposite to v */
    vec2s uv;      /* second set of texture coordinates */
};

struct mesh {
    struct mesh_vertex *vertices;
    struct mesh_extra *extras; /* optional vertex attributes, one element per vertex, or NULL */
    uint32_t *indices;         /* three vertex indices per triangle */
    uint32_t vertex_count;
    uint32_t index_count;
};

/* Axis-aligned bounding box; all zeros for an empty mesh. */
struct box {
    vec3s min, max;
};

/* Allocates zeroed arrays. Returns false on overflow or out of memory; *mesh is then zeroed. */
bool mesh_init(struct mesh *mesh, uint32_t vertex_count, uint32_t index_count);

/* Allocates zeroed vertex extras, unless they exist. Returns false when out of memory. */
bool mesh_add_extras(struct mesh *mesh);

/* Frees the arrays and zeroes the mesh. Does nothing to a zeroed mesh. */
void mesh_finish(struct mesh *mesh);

/* Appends a copy of a mesh. Returns false on overflow or out of memory; *mesh is then unchanged. */
bool mesh_append(struct mesh *mesh, const struct mesh *other);

/* Returns the number of rows of MESH_EXTRA_WIDTH texels in the GPU table of vertex extras. */
static inline uint32_t mesh_extra_row_count(uint32_t vertex_count)
{
    return (vertex_count + MESH_EXTRA_WIDTH / MESH_EXTRA_TEXELS - 1) /
           (MESH_EXTRA_WIDTH / MESH_EXTRA_TEXELS);
}

struct box mesh_box(const struct mesh *mesh);

vec3s box_center(struct box box);

/* Returns true if `inner` is inside `outer`; touching counts as inside. */
bool box_contains(const struct box *outer, const struct box *inner);

float box_diagonal(struct box box);

/* Moves the mesh's centre to the origin, and scales the mesh uniformly to `width` along x. The mesh
 * must not be flat along x. Normals are unchanged. */
void mesh_fit(struct mesh *mesh, float width);

/* Computes each vertex normal as a weighted mean of the adjacent triangles' normals. The weight is
 * the triangle's angle at the vertex, because triangulation must not affect the mean (Thuermer and
 * Wuethrich 1998). If there are no adjacent triangles of non-zero area, the normal is +Y. */
void mesh_make_normals(struct mesh *mesh);

#define MESH_CONVEX_MAX (1u << 24)
/* Returns true if the mesh is closed and convex, with a tolerance of 1e-5 of its diagonal. If
 * vertices times triangles exceed MESH_CONVEX_MAX, returns false without a test. */
bool mesh_is_convex(const struct mesh *mesh);

/* Original index of each triangle of a sorted mesh. */
struct mesh_order {
    uint32_t *all;
    uint32_t count;
};

/* Sorts triangles front to back from a point, so that early depth tests reject most hidden
 * fragments. Distances are quantised to shells, each less than a quarter farther than the last,
 * that keep the file's order for vertex caches. *order, unless NULL, gets an array that the caller
 * frees. Returns false when out of memory; *mesh is then unchanged, and *order zeroed. */
bool mesh_sort_by_distance(struct mesh *mesh, vec3s from, struct mesh_order *order);

#endif
