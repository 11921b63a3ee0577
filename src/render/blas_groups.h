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

/* Groups the triangles of a BVH by object if `by_objects` is true, otherwise by BVH root. If out of
 * memory, logs an error and leaves *groups empty. */
MUST_USE enum status blas_groups_init(struct gpu_blas_groups *groups, const struct bvh *bvh,
                                      bool by_objects);

/* Sets the instance transform of each group that has only moved since `built`, and keeps its
 * vertices from `built`. Returns false if the number or the sizes of groups differ. */
bool blas_groups_keep(struct gpu_blas_groups *groups, const struct gpu_blas_groups *built);

#endif
