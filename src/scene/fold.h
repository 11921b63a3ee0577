/* fold.h: depth complexity of a mesh: how much of it the two-interface refraction models miss. */
#ifndef FIRN_SCENE_FOLD_H
#define FIRN_SCENE_FOLD_H

#include "src/scene/mesh.h"

/*
 * Returns the fraction of lines with more than two triangle hits among all lines that hit the mesh,
 * along three fixed directions. It is 0 for a convex mesh, almost 0 with shallow hollows, and about
 * the fraction that the cavity covers for a hollow mesh.
 */
float mesh_fold(const struct mesh *mesh);

#endif
