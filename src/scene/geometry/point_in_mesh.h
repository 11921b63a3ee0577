/*
 * point_in_mesh.h: tests whether points are inside a closed mesh. closed_mesh_init() borrows the
 * mesh, which must stay unchanged. closed_mesh_finish() does not free the mesh. A zeroed struct is
 * valid and empty. Functions that take a const struct may run in several threads at once.
 */
#ifndef FIRN_SCENE_GEOMETRY_POINT_IN_MESH_H
#define FIRN_SCENE_GEOMETRY_POINT_IN_MESH_H

#include "src/scene/geometry/mesh.h"

/* Triangles of a mesh, binned into a grid of columns along y. */
struct closed_mesh {
    const struct mesh *mesh;
    struct box box;
    uint32_t side;       /* number of grid columns along x, and along z */
    uint32_t *first;     /* start of each column in `triangles`; side * side + 1 elements */
    uint32_t *triangles; /* index of each triangle's first corner in mesh->indices */
};

/* Builds the grid. Returns false when out of memory; *closed_mesh is then zeroed. */
bool closed_mesh_init(struct closed_mesh *closed_mesh, const struct mesh *mesh);

void closed_mesh_finish(struct closed_mesh *closed_mesh);

/* Returns the cost of a test of a point, in triangles. */
uint32_t closed_mesh_cost(const struct closed_mesh *s, vec3s point);

/* Returns true if a point is inside the mesh: a ray upwards hits an odd number of triangles. If the
 * ray passes through a shared edge, it hits exactly one of the edge's two triangles. */
bool closed_mesh_contains(const struct closed_mesh *s, vec3s point);

/* Returns true if the surface is both above and below a point, for example in a cavity. */
bool closed_mesh_surrounds(const struct closed_mesh *s, vec3s point);

#endif
