/*
 * blas_groups.h: groups of the BVH's triangles, one BLAS each (src/gpu/gpu_acceleration.h).
 *
 * A ray query must report every triangle that the shader's own BVH test would hit, whatever
 * rounding a device has. So vertices are derived from the BVH's encoded triangles, and each
 * triangle is enlarged on every side by a small fraction of the scene. Each BVH root is a group; in
 * an animated model each object is one. A group that has only been moved, rotated or scaled
 * uniformly since its structure was built keeps the structure and gets a new instance transform.
 *
 * Ownership: gpu_blas_groups_finish() frees the content of the groups.
 */
#ifndef FIRN_RENDER_BLAS_GROUPS_H
#define FIRN_RENDER_BLAS_GROUPS_H

#include "src/gpu/gpu_acceleration.h"
#include "src/scene/bvh/bvh.h"

/* Groups the triangles of a BVH, by object if `by_objects`, else by BVH root. When out of memory
 * logs and leaves *groups empty. */
MUST_USE enum status blas_groups_init(struct gpu_blas_groups *groups, const struct bvh *bvh,
                                      bool by_objects);

/* Keeps the vertices of `built` for each group that has only moved since then, and sets the group's
 * instance transform. Returns false if the number of groups or the size of a group differs. */
bool blas_groups_keep(struct gpu_blas_groups *groups, const struct gpu_blas_groups *built);

#endif
