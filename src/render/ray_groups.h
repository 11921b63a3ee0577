/*
 * ray_groups.h: a tree's triangles in groups for acceleration structures (src/gpu/gpu_rays.h).
 *
 * The structures are to find all triangles that rays may meet by the tree's words, with whatever
 * rounding a device has. So a triangle's corners are made from its words, which have its sides, and
 * it is larger on each side by a small part of the scene. A part of the scene is a group; of a
 * model that has poses, each object is. What has moved since the structures were built, turned or
 * been scaled evenly, keeps them, and gets another place.
 *
 * Ownership: gpu_ray_groups_finish() frees what is in groups.
 */
#ifndef FIRN_RENDER_RAY_GROUPS_H
#define FIRN_RENDER_RAY_GROUPS_H

#include "src/gpu/gpu_rays.h"
#include "src/scene/tree.h"

/* Makes the groups of a tree, with one for each object if `by_objects`; none is kept. Logs when out
 * of memory; *groups is then {0}. */
MUST_USE enum status ray_groups_init(struct gpu_ray_groups *groups, const struct tree *tree,
                                     bool by_objects);

/* Keeps of the groups those that have only moved since others' structures were built: they get the
 * others' corners, and their places. Returns false if they are not as many, each as large. */
bool ray_groups_keep(struct gpu_ray_groups *groups, const struct gpu_ray_groups *built);

#endif
