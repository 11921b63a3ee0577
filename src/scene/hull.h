/*
 * hull.h: a mesh within few planes, and polygons cut to it.
 *
 * The directions are those from a cube's middle to its faces, edges and corners (Klosowski and
 * others 1998: a discrete orientation polytope of 26 planes); the mesh touches each plane.
 */
#ifndef FIRN_SCENE_HULL_H
#define FIRN_SCENE_HULL_H

#include "src/scene/mesh.h"

enum {
    HULL_PLANE_COUNT = 26,
    HULL_CORNER_COUNT = 4 + HULL_PLANE_COUNT, /* of a square that was cut, at most */
};

/* Points p of the hull have dot(p, planes[i].xyz) <= planes[i].w. */
struct hull {
    vec4s planes[HULL_PLANE_COUNT];
};

/* An empty mesh has an empty hull. */
struct hull hull_of(const struct mesh *mesh);

/*
 * Cuts a convex polygon, of `count` corners, to the hull; returns how many are left: 0, or from 3
 * to `count` + HULL_PLANE_COUNT, for which `corners` has room. What a corner carries besides its
 * position (uv) goes along, the rest is that of the first one.
 */
uint32_t hull_cut(const struct hull *hull, struct mesh_vertex *corners, uint32_t count);

#endif
