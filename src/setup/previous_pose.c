/* previous_pose.c: vertex positions and camera of an animated model in the previous frame. */
#include "src/setup/previous_pose.h"
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/setup/aov_to_png.h"
#include "src/tech/output/first_surface.h"

bool previous_pose_is_needed(const struct setup_image *image)
{
    const struct frame_layer *motion = layer_image_find("motion");
    return image->show == motion || image->layers & layer_image_bit(motion);
}

static enum status copy(struct previous_pose *previous, const struct model *model)
{
    const struct mesh *const meshes[] = { &model->object, &model->surroundings };
    vec4s *to = calloc((size_t)first_surface_rows(model) * FIRST_SURFACE_WIDTH, sizeof(*to));
    *previous =
        (struct previous_pose){ to, model->object.vertex_count, model->surroundings.vertex_count };
    if (!to)
        return log_out_of_memory("the layer motion");
    for (size_t m = 0; m < 2; m++) {
        for (uint32_t i = 0; i < meshes[m]->vertex_count; i++)
            *to++ = glms_vec4(meshes[m]->vertices[i].position, 1.0f);
    }
    return STATUS_OK;
}

enum status previous_pose_find(struct previous_pose *previous, struct camera *camera,
                               struct scene *scene, const struct setup_image *image, float time)
{
    const float before = frame_time_before(&image->scene.settings, time);
    bool is_changed;
    *previous = (struct previous_pose){ 0 };
    if (!scene->is_animated || !previous_pose_is_needed(image) || !(before < time))
        return STATUS_OK;
    enum status status = setup_pose_scene(scene, &image->scene, before, &is_changed);
    if (status == STATUS_OK)
        status = setup_camera(camera, scene, image);
    return status == STATUS_OK ? copy(previous, &scene->model) : status;
}

void previous_pose_move_to(struct previous_pose *previous, struct scene *scene)
{
    const struct model *model = &scene->model;
    if (previous->positions && previous->object_count == model->object.vertex_count &&
        previous->surroundings_count == model->surroundings.vertex_count) {
        free(scene->previous_positions);
        scene->previous_positions = previous->positions;
        previous->positions = NULL;
    }
    free(previous->positions);
    *previous = (struct previous_pose){ 0 };
}
