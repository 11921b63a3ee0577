/* mesh_depth_complexity.h: how much of a mesh two-interface refraction models miss. */
#ifndef FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H
#define FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H

#include "src/scene/geometry/mesh.h"

/* Returns the fraction of lines with more than two triangle hits among all lines that hit the mesh,
 * along three fixed directions. It is 0 for a convex mesh, almost 0 with shallow hollows, and about
 * the fraction that the cavity covers for a hollow mesh. */
float mesh_depth_complexity(const struct mesh *mesh);

#endif
