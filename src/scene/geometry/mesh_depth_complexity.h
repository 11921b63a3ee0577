/* mesh_depth_complexity.h: measures how much of a mesh needs more than two refractions. */
#ifndef FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H
#define FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H

#include "src/scene/geometry/mesh.h"

/* Returns the fraction of lines with more than two triangle hits, among the lines along three fixed
 * directions that hit the mesh. The fraction is 0 for a convex mesh, almost 0 for shallow hollows,
 * and about as large as the part of the silhouette that a cavity covers. */
float mesh_depth_complexity(const struct mesh *mesh);

#endif
