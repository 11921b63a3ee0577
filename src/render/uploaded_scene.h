/* uploaded_scene.h: a scene's meshes and pictures on the device. */
#ifndef FIRN_RENDER_UPLOADED_SCENE_H
#define FIRN_RENDER_UPLOADED_SCENE_H

#include "graph/rg_cmd.h"
#include "src/gpu/gpu.h"
#include "src/scene/scene.h"

/* A mesh; without triangles {0}. */
struct uploaded_mesh {
    struct gpu_buffer vertices, indices;
};

/* An image that a technique imports. */
struct uploaded_image {
    const struct rg_image *declared;
    struct gpu_image image; /* {0}: the scene has none, and no texel stands in for it */
};

struct uploaded_scene {
    struct uploaded_mesh object, surroundings;
    struct uploaded_mesh *meshes; /* of techniques, as techniques_index() counts them */
    struct uploaded_image *images;
    size_t image_count;
};

/* On failure (logged) *on_gpu is {0}. */
MUST_USE enum status uploaded_scene_init(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                         const struct scene *scene);

void uploaded_scene_finish(struct uploaded_scene *on_gpu, struct gpu *gpu);

/* To draw it. */
struct rg_mesh uploaded_scene_mesh(const struct uploaded_mesh *mesh);

/* The image that was uploaded for a declaration, or VK_NULL_HANDLE. */
VkImage uploaded_scene_image(const struct uploaded_scene *on_gpu, const struct rg_image *declared);

#endif
