/* kdop.h: computes a mesh's discrete oriented polytope (26-DOP), and clips polygons to it. The
 * plane normals point from a cube's centre to its faces, edges and corners (Klosowski et al. 1998).
 * Each plane touches the mesh. */
#ifndef FIRN_SCENE_GEOMETRY_KDOP_H
#define FIRN_SCENE_GEOMETRY_KDOP_H

#include "src/scene/geometry/mesh.h"

enum {
    KDOP_PLANE_COUNT = 26,
    KDOP_CORNER_COUNT = 4 + KDOP_PLANE_COUNT, /* maximum vertices of a clipped square */
};

/* Intersection of half-spaces: p is inside if dot(p, planes[i].xyz) <= planes[i].w for all i. */
struct kdop {
    vec4s planes[KDOP_PLANE_COUNT];
};

/* Returns the k-DOP of a mesh, which is empty for an empty mesh. */
struct kdop kdop_of(const struct mesh *mesh);

/* Clips a convex polygon of `count` <= 4 vertices to the k-DOP, in place. Returns the new vertex
 * count. `corners` needs room for `count` + KDOP_PLANE_COUNT vertices. New vertices interpolate
 * position and texture coordinates, and copy the rest from one end of the edge. */
uint32_t kdop_clip(const struct kdop *kdop, struct mesh_vertex *corners, uint32_t count);

#endif
