/*
 * hull.h: a convex polytope around a mesh, and polygons clipped to it.
 *
 * Its normals are the directions from a cube's middle to its faces, edges and corners (Klosowski
 * and others 1998: a discrete orientation polytope of 26 planes); the mesh touches each plane.
 */
#ifndef FIRN_SCENE_HULL_H
#define FIRN_SCENE_HULL_H

#include "src/scene/mesh.h"

enum {
    HULL_PLANE_COUNT = 26,
    HULL_CORNER_COUNT = 4 + HULL_PLANE_COUNT, /* greatest number of corners of a clipped square */
};

/* Points p of the hull have dot(p, planes[i].xyz) <= planes[i].w. */
struct hull {
    vec4s planes[HULL_PLANE_COUNT];
};

/* Returns the hull of a mesh; an empty mesh has an empty hull. */
struct hull hull_of(const struct mesh *mesh);

/*
 * Clips a convex polygon of `count` corners to the hull and returns the new number of corners: 0,
 * or from 3 to `count` + HULL_PLANE_COUNT, for which `corners` must have room. New corners have
 * interpolated uv and the other attributes of the first corner.
 */
uint32_t hull_cut(const struct hull *hull, struct mesh_vertex *corners, uint32_t count);

#endif
