/* uploaded_scene.h: a scene's meshes, images, buffers and acceleration structures on the device. */
#ifndef FIRN_RENDER_UPLOADED_SCENE_H
#define FIRN_RENDER_UPLOADED_SCENE_H

#include "graph/rg_cmd.h"
#include "src/gpu/gpu_acceleration.h"
#include "src/scene/scene.h"

/* Vertex and index buffers of a mesh. A mesh without triangles has none. */
struct uploaded_mesh {
    struct gpu_buffer vertices, indices;
    struct gpu_buffer coarse; /* simplified mesh; {0} without one */
};

/* An image or a buffer that a technique imports. */
struct uploaded_import {
    const struct rg_image *declared; /* NULL if it is a buffer */
    struct gpu_image image;          /* {0} without image and fallback */
    const struct rg_buffer *declared_buffer;
    struct gpu_buffer buffer;
};

struct uploaded_scene {
    struct uploaded_mesh object, surroundings;
    struct uploaded_mesh *meshes; /* meshes of the techniques, by techniques_index() */
    struct uploaded_import *imports;
    size_t import_count;
    struct gpu_acceleration *rays; /* NULL without ray queries */
    bool has_poses;                /* animated: further poses may follow */
};

/* Checks that the device supports the image sizes of the scene, before anything is allocated. If it
 * does not, logs an error and returns STATUS_DATA. */
MUST_USE enum status uploaded_scene_check(const struct gpu *gpu, const struct scene *scene);

/* Uploads a scene without its BVH. Logs errors; on failure *on_gpu is empty. */
MUST_USE enum status uploaded_scene_init(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                         const struct scene *scene);

/* Uploads only the buffers of a scene's BVH. If there is no BVH yet, uploads zeros. */
MUST_USE enum status uploaded_scene_init_bvh(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                             const struct scene *scene);

/* Builds the acceleration structures of a scene's BVH, unless they exist. If an object has only
 * moved, its structures from the previous pose, kept by uploaded_scene_finish(), are used again. */
MUST_USE enum status uploaded_scene_build_acceleration(struct uploaded_scene *on_gpu,
                                                       struct gpu *gpu, const struct scene *scene);

/* Simplifies the meshes of the object (unless there are several) and of the surroundings, for
 * renderers with params.is_coarse. The error is at most 0.003 of the object's size and 0.0003 of
 * the surroundings'. This pays off for CPU drivers, which shade whole pixel blocks for each
 * triangle. Returns STATUS_TRY_AGAIN when out of memory; the scene is then unchanged. */
MUST_USE enum status uploaded_scene_add_simplified(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                                   const struct scene *scene);

void uploaded_scene_finish(struct uploaded_scene *on_gpu, struct gpu *gpu);

/* Returns the mesh's buffers for rg_cmd. If `is_coarse`, prefers the simplified mesh. */
struct rg_mesh uploaded_scene_mesh(const struct uploaded_mesh *mesh, bool is_coarse);

/* Returns the image uploaded for `declared`, or VK_NULL_HANDLE. */
VkImage uploaded_scene_image(const struct uploaded_scene *on_gpu, const struct rg_image *declared);

/* Returns the buffer uploaded for `declared`, or VK_NULL_HANDLE. */
VkBuffer uploaded_scene_buffer(const struct uploaded_scene *on_gpu,
                               const struct rg_buffer *declared);

#endif
