/*
 * mesh.h: indexed triangles on the CPU, and the one vertex layout every pass draws with.
 *
 * Space:     whatever the owner says; world space once in a scene (right-handed, +Y up, metres).
 * Winding:   counter-clockwise seen from outside.
 * Ownership: a mesh owns its two arrays (malloc'd); mesh_finish() frees them.
 */
#ifndef FIRN_SCENE_MESH_H
#define FIRN_SCENE_MESH_H

#include <cglm/struct.h>
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

struct mesh {
    struct mesh_vertex *vertices;
    uint32_t *indices; /* three a triangle */
    uint32_t vertex_count;
    uint32_t index_count;
};

/* Axis-aligned box. An empty mesh's box is {0}. */
struct box {
    vec3s min, max;
};

/*
 * Allocates room for the given counts, all zero. False when memory is short or the sizes
 * overflow; *mesh is then {0}.
 */
bool mesh_init(struct mesh *mesh, uint32_t vertex_count, uint32_t index_count);

/* Frees the arrays and leaves *mesh {0}. A {0} mesh is fine. */
void mesh_finish(struct mesh *mesh);

/* Appends a copy of `other`, another mesh. False when memory is short or the counts overflow:
 * *mesh is unchanged. */
bool mesh_append(struct mesh *mesh, const struct mesh *other);

struct box mesh_box(const struct mesh *mesh);

vec3s box_center(struct box box);

/* Length of the diagonal. */
float box_diagonal(struct box box);

/* Moves the box's centre to the origin and scales evenly until the box is `width` wide along x,
 * where it must have an extent. Normals stay. */
void mesh_fit(struct mesh *mesh, float width);

/*
 * Sets every vertex normal to the mean of its triangles' normals weighted by their angles there,
 * which does not depend on how a surface is cut into triangles (Thuermer and Wuethrich 1998).
 * Vertices of no triangle with an area get +Y.
 */
void mesh_make_normals(struct mesh *mesh);

/*
 * Whether no vertex lies outside of any triangle's plane, to a hundred thousandth of the size, and
 * the triangles close: then a ray is inside once at most. Not asked of more than MESH_CONVEX_MAX
 * pairs of a triangle and a vertex: false.
 */
#define MESH_CONVEX_MAX (1u << 24)
bool mesh_is_convex(const struct mesh *mesh);

/*
 * Puts triangles first that are nearer to a point: a depth test then leaves out most of what others
 * hide from there. By shells, each less than a quarter larger than the last, in which the order
 * stays, for caches of vertices. False when memory is short: *mesh is unchanged.
 */
bool mesh_sort_by_distance(struct mesh *mesh, vec3s from);

#endif
