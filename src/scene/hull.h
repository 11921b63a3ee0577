/*
 * hull.h: discrete oriented polytope (26-DOP) around a mesh, and clipping of polygons to it.
 *
 * Its normals point from a cube's centre to the faces, edges and corners (Klosowski et al. 1998);
 * the mesh touches each plane.
 */
#ifndef FIRN_SCENE_HULL_H
#define FIRN_SCENE_HULL_H

#include "src/scene/mesh.h"

enum {
    HULL_PLANE_COUNT = 26,
    HULL_CORNER_COUNT = 4 + HULL_PLANE_COUNT, /* maximum vertex count of a clipped square */
};

/* A point p is inside if dot(p, planes[i].xyz) <= planes[i].w for all i. */
struct hull {
    vec4s planes[HULL_PLANE_COUNT];
};

/* Returns the k-DOP of a mesh; that of an empty mesh is empty. */
struct hull hull_of(const struct mesh *mesh);

/*
 * Clips a convex polygon of `count` vertices to the k-DOP. Returns the new vertex count, which is
 * 0, or 3 to `count` + HULL_PLANE_COUNT; `corners` must have room for it. New vertices interpolate
 * the texture coordinates and copy the other attributes of the first vertex.
 */
uint32_t hull_cut(const struct hull *hull, struct mesh_vertex *corners, uint32_t count);

#endif
