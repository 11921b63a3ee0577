/* mesh_depth_complexity.h: measures how much of a mesh needs more than two refractions. */
#ifndef FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H
#define FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H

#include "src/scene/geometry/mesh.h"

/* Returns the fraction of lines that hit more than two triangles, among lines along three fixed
 * directions that hit the mesh. It is 0 for a convex mesh, and almost 0 for shallow hollows. For a
 * cavity, it is about the fraction of the silhouette that the cavity covers. */
float mesh_depth_complexity(const struct mesh *mesh);

#endif
