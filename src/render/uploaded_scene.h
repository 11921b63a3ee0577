/* uploaded_scene.h: a scene's meshes and pictures on the device. */
#ifndef FIRN_RENDER_UPLOADED_SCENE_H
#define FIRN_RENDER_UPLOADED_SCENE_H

#include "src/frame/plan.h"
#include "src/gpu/gpu.h"
#include "src/scene/scene.h"

struct uploaded_scene {
    struct gpu_buffer object_vertices, object_indices;
    struct gpu_buffer surroundings_vertices, surroundings_indices;
    struct gpu_buffer cracks_vertices, cracks_indices;
    struct gpu_image environment; /* 1x1 if the scene has none */
    struct gpu_image cube;        /* {0} if the scene has none */
    struct gpu_image textures;    /* 1x1 if the scene has none */
    struct gpu_image bump_map;    /* the same */
    struct gpu_buffer air_vertices, air_indices;
    struct gpu_image air_layers; /* 1x1 if the scene has none */
};

/* Fills what a plan must know of the scene's pictures; needs no device. */
void uploaded_scene_describe(const struct scene *scene, struct frame_request *request);

/* On failure (logged) *on_gpu is {0}. */
MUST_USE enum status uploaded_scene_init(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                         const struct scene *scene);

void uploaded_scene_finish(struct uploaded_scene *on_gpu, struct gpu *gpu);

#endif
