/*
 * solid.h: tests whether points are inside a closed mesh.
 *
 * Ownership:     solid_init() borrows the mesh, which must stay unchanged; solid_finish() frees the
 *                rest. A {0} struct is fine, and contains nothing.
 * Thread-safety: several threads may call functions with a const struct at the same time.
 */
#ifndef FIRN_SCENE_SOLID_H
#define FIRN_SCENE_SOLID_H

#include "src/scene/mesh.h"

/* Triangles of a mesh, binned into a grid of columns along y. */
struct solid {
    const struct mesh *mesh;
    struct box box;
    uint32_t side;       /* number of columns along x, and along z */
    uint32_t *first;     /* start of each column in `triangles`; side * side + 1 elements */
    uint32_t *triangles; /* index of each triangle's first corner in mesh->indices */
};

/* Builds the grid. Returns false when out of memory; *solid is then {0}. */
bool solid_init(struct solid *solid, const struct mesh *mesh);

void solid_finish(struct solid *solid);

/*
 * Returns true if a point is inside: an upward ray from it hits an odd number of triangles. A ray
 * through a shared edge hits exactly one of the two triangles.
 */
bool solid_contains(const struct solid *solid, vec3s point);

/* Returns true if the surface is both above and below a point, which may be in a cavity. */
bool solid_surrounds(const struct solid *solid, vec3s point);

/* Returns true if the bounding box of a triangle overlaps a box. */
bool solid_is_near(const struct solid *solid, struct box box);

/*
 * Clips a sheet (any triangles) to the inside of the closed mesh. Triangles near the surface are
 * bisected until no side is longer than `step` metres, then cut where their sides cross the
 * surface; smaller features are missed. The result shares no vertices. Returns false when out of
 * memory; *sheet is then unchanged.
 */
bool solid_cut(const struct solid *solid, struct mesh *sheet, float step);

#endif
