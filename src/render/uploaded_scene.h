/* uploaded_scene.h: a scene's meshes and images on the device. */
#ifndef FIRN_RENDER_UPLOADED_SCENE_H
#define FIRN_RENDER_UPLOADED_SCENE_H

#include "graph/rg_cmd.h"
#include "src/gpu/gpu_rays.h"
#include "src/scene/scene.h"

/* A mesh's buffers; {0} if it has no triangles. */
struct uploaded_mesh {
    struct gpu_buffer vertices, indices;
    struct gpu_buffer coarse; /* indices of fewer triangles; {0}: there are none */
};

/* An image or a buffer that a technique imports. */
struct uploaded_import {
    const struct rg_image *declared; /* NULL: it is a buffer */
    struct gpu_image image;          /* {0}: the scene has none, and the import has no fallback */
    const struct rg_buffer *declared_buffer;
    struct gpu_buffer buffer;
};

struct uploaded_scene {
    struct uploaded_mesh object, surroundings;
    struct uploaded_mesh *meshes; /* of the techniques, by techniques_index() */
    struct uploaded_import *imports;
    size_t import_count;
    struct gpu_rays *rays; /* NULL: none is needed */
    bool has_poses;        /* the scene has others */
};

/* Checks before any allocation that the device supports the sizes of the scene's pictures. If not,
 * logs and returns STATUS_DATA. */
MUST_USE enum status uploaded_scene_check(const struct gpu *gpu, const struct scene *scene);

/* Uploads a scene without its tree. Logs errors; on failure *on_gpu is {0}. */
MUST_USE enum status uploaded_scene_init(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                         const struct scene *scene);

/* Uploads only the buffers of a scene's tree, or zeros where it has not been built. */
MUST_USE enum status uploaded_scene_init_tree(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                              const struct scene *scene);

/* Builds the acceleration structures of a scene's tree, unless there are any. Of what only moved
 * since a pose before, whose upload has been finished, it takes those. */
MUST_USE enum status uploaded_scene_need_rays(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                              const struct scene *scene);

/*
 * Adds fewer triangles of the same vertices for the object, unless there are several, and for the
 * surroundings: renderers with params.is_coarse draw those. They are 0.003 of the object's size
 * off, and 0.0003 of the surroundings'. A driver for the CPU shades whole blocks of pixels for each
 * triangle. STATUS_TRY_AGAIN: no memory for them; the scene is as it was.
 */
MUST_USE enum status uploaded_scene_add_coarse(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                               const struct scene *scene);

void uploaded_scene_finish(struct uploaded_scene *on_gpu, struct gpu *gpu);

/* Returns what rg_cmd needs to draw the mesh, or its coarse triangles if it has some. */
struct rg_mesh uploaded_scene_mesh(const struct uploaded_mesh *mesh, bool is_coarse);

/* Returns the image that was uploaded for a declaration, or VK_NULL_HANDLE. */
VkImage uploaded_scene_image(const struct uploaded_scene *on_gpu, const struct rg_image *declared);

/* Returns the buffer that was uploaded for a declaration, or VK_NULL_HANDLE. */
VkBuffer uploaded_scene_buffer(const struct uploaded_scene *on_gpu,
                               const struct rg_buffer *declared);

#endif
