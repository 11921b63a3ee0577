/*
 * gpu_rays.h: acceleration structures of triangles, which ray queries of shaders meet.
 *
 * Groups of triangles have a structure each, and one is above them, in which each group has a place
 * of its own. A group that only moves keeps its structure.
 *
 * Ownership:     structures own their memory; gpu_rays_destroy() frees it before gpu_destroy().
 * Errors:        as gpu.h.
 * Thread-safety: as gpu.h.
 */
#ifndef FIRN_GPU_GPU_RAYS_H
#define FIRN_GPU_GPU_RAYS_H

#include "src/gpu/gpu.h"

/* What a ray query tells of a triangle: `first` of the group as the instance's record offset (of
 * shader binding tables, which queries have none of), and the triangle's number in the group as the
 * primitive's index. lavapipe (Mesa 25.0) would read a custom index for rays, too, that met
 * nothing, at no valid address. */
struct gpu_ray_group {
    uint32_t first, count; /* triangles; the count is not 0 */
    uint8_t mask;          /* of rays that may meet it */
    bool is_kept;          /* its corners are those of the last build, and so its structure stays */
    VkTransformMatrixKHR place;
};

struct gpu_ray_groups {
    struct gpu_ray_group *all;
    uint32_t count;
    float (*corners)[3][3]; /* of the triangles */
    float room;             /* metres, on each side of a triangle, by which it is larger */
};

/* Frees what is in groups; {0} is fine. */
void gpu_ray_groups_finish(struct gpu_ray_groups *groups);

struct gpu_rays {
    struct gpu_buffer lower_memory, upper_memory;
    VkAccelerationStructureKHR *lowers; /* of the groups, in `lower_memory` */
    VkAccelerationStructureKHR upper;   /* that shaders trace; in `upper_memory` */
    VkDeviceSize size;                  /* bytes of all structures */
    VkDeviceSize scratch_size;          /* that a build takes at most */
    double ms;                          /* time of the last build; set by its user */
    uint32_t count;                     /* groups */
    struct gpu_ray_groups built;        /* as of the last build */
};

/* Makes room for groups, of which only the counts are read, unless the device has too little
 * memory (gpu_fit_rays()); gpu->has_rays is set. On failure *rays is NULL. */
MUST_USE enum status gpu_rays_create(struct gpu *gpu, struct gpu_rays **rays,
                                     const struct gpu_ray_groups *groups);

/*
 * Builds the structures of groups that are not kept, and the one above all, and takes the groups:
 * *groups is then {0}. Waits until shaders can trace the structures; nothing may trace them
 * meanwhile.
 */
MUST_USE enum status gpu_rays_build(struct gpu *gpu, struct gpu_rays *rays,
                                    struct gpu_ray_groups *groups);

/* NULL is fine. */
void gpu_rays_destroy(struct gpu *gpu, struct gpu_rays *rays);

#endif
