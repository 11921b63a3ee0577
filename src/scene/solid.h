/*
 * solid.h: the inside of a closed mesh.
 *
 * Ownership: solid_init() borrows the mesh, which outlives the solid unchanged; solid_finish()
 *            frees the rest. A {0} solid is fine to finish, and contains nothing.
 * Threads:   many may ask at a time.
 */
#ifndef FIRN_SCENE_SOLID_H
#define FIRN_SCENE_SOLID_H

#include "src/scene/mesh.h"

/* Its triangles in a grid of columns along y. */
struct solid {
    const struct mesh *mesh;
    struct box box;
    uint32_t side;       /* columns along x, and along z */
    uint32_t *first;     /* side * side + 1: of each column in `triangles` */
    uint32_t *triangles; /* their first indices */
};

/* False when memory is short; *solid is then {0}. */
bool solid_init(struct solid *solid, const struct mesh *mesh);

void solid_finish(struct solid *solid);

/*
 * Whether a point lies inside: a ray from it upwards meets an odd number of triangles. Neighbours
 * agree to whom their common edge belongs, so that no ray slips through.
 */
bool solid_contains(const struct solid *solid, vec3s point);

/* Whether the surface may come near: the box of some triangle meets this one. */
bool solid_is_near(const struct solid *solid, struct box box);

/*
 * Cuts away what of a sheet (any triangles) lies outside. Triangles near the surface are halved
 * until no side is longer than `step` metres, then cut straight where their sides cross it: smaller
 * features are missed. Vertices are no longer shared. False when memory is short; *sheet is then
 * unchanged.
 */
bool solid_cut(const struct solid *solid, struct mesh *sheet, float step);

#endif
