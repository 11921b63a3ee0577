/* fold.h: how much of a mesh is behind other parts of it, so that two faces do not show it. */
#ifndef FIRN_SCENE_FOLD_H
#define FIRN_SCENE_FOLD_H

#include "src/scene/mesh.h"

/*
 * Returns, of the lines through a mesh along three fixed directions that meet any of its triangles,
 * the share that meets more than two. A convex mesh has 0, one with shallow hollows almost 0, and a
 * hollow one about the share that its cavity covers.
 */
float mesh_fold(const struct mesh *mesh);

#endif
