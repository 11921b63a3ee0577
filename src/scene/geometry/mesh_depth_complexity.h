/* mesh_depth_complexity.h: measures how much of a mesh needs more than two refractions. */
#ifndef FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H
#define FIRN_SCENE_GEOMETRY_MESH_DEPTH_COMPLEXITY_H

#include "src/scene/geometry/mesh.h"

/* Returns the fraction of lines that hit more than two triangles, among all lines that hit the
 * mesh. Lines have three fixed directions. The fraction is 0 if convex, and almost 0 for shallow
 * hollows. For a cavity, it is about the part of the silhouette that the cavity covers. */
float mesh_depth_complexity(const struct mesh *mesh);

#endif
