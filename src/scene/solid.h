/*
 * solid.h: tests whether points are inside a closed mesh.
 *
 * Ownership:     solid_init() borrows the mesh, which must outlive the solid unchanged;
 *                solid_finish() frees the rest. A {0} solid is fine, and contains nothing.
 * Thread-safety: several threads may call functions with a const solid at the same time.
 */
#ifndef FIRN_SCENE_SOLID_H
#define FIRN_SCENE_SOLID_H

#include "src/scene/mesh.h"

/* The triangles of a mesh in a grid of columns along y. */
struct solid {
    const struct mesh *mesh;
    struct box box;
    uint32_t side;       /* columns along x, and along z */
    uint32_t *first;     /* side * side + 1 elements: start of each column in `triangles` */
    uint32_t *triangles; /* index of each triangle's first corner in mesh->indices */
};

/* Builds the grid. Returns false when out of memory; *solid is then {0}. */
bool solid_init(struct solid *solid, const struct mesh *mesh);

void solid_finish(struct solid *solid);

/*
 * Returns whether a point is inside: a ray upwards from it meets an odd number of triangles. Two
 * triangles that share an edge never both meet or both miss a ray through it.
 */
bool solid_contains(const struct solid *solid, vec3s point);

/* Returns whether the surface is both above and below a point, which may be in a cavity. */
bool solid_surrounds(const struct solid *solid, vec3s point);

/* Returns whether the surface may be in a box: the box of a triangle intersects it. */
bool solid_is_near(const struct solid *solid, struct box box);

/*
 * Clips a sheet (any triangles) to the inside. Triangles near the surface are halved until no side
 * is longer than `step` metres, then cut straight where their sides cross the surface: smaller
 * features are missed. The result shares no vertices. Returns false when out of memory; *sheet is
 * then unchanged.
 */
bool solid_cut(const struct solid *solid, struct mesh *sheet, float step);

#endif
