/*
 * gpu_acceleration.h: acceleration structures for ray queries in shaders.
 *
 * Each group of triangles has a bottom-level structure (BLAS). The only top-level structure (TLAS)
 * has one instance per BLAS, with a transform. A group that only moves keeps its BLAS.
 *
 * Structures own their memory. Call gpu_acceleration_destroy() before gpu_destroy(). gpu.h
 * describes errors and thread safety.
 */
#ifndef FIRN_GPU_GPU_ACCELERATION_H
#define FIRN_GPU_GPU_ACCELERATION_H

#include "src/gpu/gpu.h"

/* A group of triangles with a BLAS. A ray query identifies a triangle by its primitive index plus
 * the instance's record offset, which is `first`. The custom index is not used, because lavapipe
 * (Mesa 25.0) reads it at an invalid address if a ray misses. */
struct gpu_blas_group {
    uint32_t first, count; /* triangles; the count is not 0 */
    uint8_t mask;          /* instance mask of ray queries */
    bool is_kept;          /* unchanged, so keep its BLAS */
    VkTransformMatrixKHR transform;
};

struct gpu_blas_groups {
    struct gpu_blas_group *all;
    uint32_t count;
    float (*corners)[3][3]; /* vertex positions of the triangles */
    float margin;           /* enlargement of each triangle, metres */
};

/* Frees the content of *groups, which may be zeroed. */
void gpu_blas_groups_finish(struct gpu_blas_groups *groups);

struct gpu_acceleration {
    struct gpu_buffer blas_memory, tlas_memory;
    VkAccelerationStructureKHR *blas_handles; /* BLAS of each group, in `blas_memory` */
    VkAccelerationStructureKHR tlas;          /* TLAS that shaders trace; in `tlas_memory` */
    VkDeviceSize size;                        /* size of all structures, bytes */
    VkDeviceSize scratch_size;                /* maximum of all builds, bytes */
    double ms;                                /* last build's milliseconds; by the caller */
    uint32_t count;                           /* number of groups */
    struct gpu_blas_groups built;             /* groups of the last build */
};

/* Creates acceleration structures without building them. Reads only the triangle counts of
 * `groups`. Requires gpu->has_rays. On failure *rays is NULL. */
MUST_USE enum status gpu_acceleration_create(struct gpu *gpu, struct gpu_acceleration **rays,
                                             const struct gpu_blas_groups *groups);

/* Builds the TLAS, and each BLAS whose group is not kept (is_kept). Moves `groups` to *rays and
 * zeroes *groups. Returns after the build. No shader may trace the structures during the build. */
MUST_USE enum status gpu_acceleration_build(struct gpu *gpu, struct gpu_acceleration *rays,
                                            struct gpu_blas_groups *groups);

/* Destroys acceleration structures; NULL is fine. */
void gpu_acceleration_destroy(struct gpu *gpu, struct gpu_acceleration *rays);

#endif
