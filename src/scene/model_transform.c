/* model_transform.c: rotates and scales a loaded model. */
#include "src/scene/model_transform.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/base/log.h"
#include "src/scene/geometry/affine.h"

static const float coordinate_max = 1e6f; /* maximum absolute coordinate, metres */

static mat4s rotation_of(const struct model_transform *model_transform)
{
    const float degree = 0.01745329252f;
    mat4s rotation = glms_mat4_identity();
    rotation = glms_rotate(rotation, model_transform->rotate_deg.z * degree,
                           (vec3s){ { 0.0f, 0.0f, 1.0f } });
    rotation = glms_rotate(rotation, model_transform->rotate_deg.y * degree,
                           (vec3s){ { 0.0f, 1.0f, 0.0f } });
    rotation = glms_rotate(rotation, model_transform->rotate_deg.x * degree,
                           (vec3s){ { 1.0f, 0.0f, 0.0f } });
    return rotation;
}

static vec3s rotated(const mat4s *rotation, const struct model_transform *model_transform, vec3s v)
{
    const vec3s upright = model_transform->is_z_up ? (vec3s){ { v.x, v.z, -v.y } } : v;
    return glms_mat4_mulv3(*rotation, upright, 0.0f);
}

static float scale_of(const struct model_transform *model_transform)
{
    return model_transform->scale > 0.0f ? model_transform->scale : 1.0f;
}

static void transform_origin(double origin[static 3], const struct model_transform *model_transform)
{
    static const double none[3], one[3] = { 1, 1, 1 };
    const double half_degree = 0.008726646259971648;
    const double y = origin[1];
    if (model_transform->is_z_up) {
        origin[1] = origin[2];
        origin[2] = -y;
    }
    for (int axis = 0; axis < 3; axis++) {
        const double half = half_degree * (double)model_transform->rotate_deg.raw[axis];
        double quaternion[4] = { 0, 0, 0, cos(half) };
        quaternion[axis] = sin(half);
        const struct affine rotation = affine_compose(none, quaternion, one);
        affine_transform(&rotation, origin);
    }
    for (int k = 0; k < 3; k++)
        origin[k] *= (double)scale_of(model_transform);
}

static bool transform_mesh(struct mesh *mesh, const mat4s *rotation,
                           const struct model_transform *model_transform)
{
    bool is_in_range = true;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct mesh_vertex *vertex = &mesh->vertices[i];
        vertex->position = glms_vec3_scale(rotated(rotation, model_transform, vertex->position),
                                           scale_of(model_transform));
        vertex->normal = rotated(rotation, model_transform, vertex->normal);
        if (mesh->extras) {
            vec3s *tangent = &mesh->extras[i].tangent;
            *tangent = rotated(rotation, model_transform, *tangent);
        }
        for (int c = 0; c < 3; c++)
            is_in_range = is_in_range && fabsf(vertex->position.raw[c]) <= coordinate_max;
    }
    return is_in_range;
}

/* Returns the bounding box of a box's transformed corners. */
static struct box transform_box(struct box box, const mat4s *rotation,
                                const struct model_transform *model_transform)
{
    struct box result = { { { INFINITY, INFINITY, INFINITY } },
                          { { -INFINITY, -INFINITY, -INFINITY } } };
    for (int corner = 0; corner < 8; corner++) {
        vec3s v = { { corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z } };
        v = glms_vec3_scale(rotated(rotation, model_transform, v), scale_of(model_transform));
        result.min = glms_vec3_minv(result.min, v);
        result.max = glms_vec3_maxv(result.max, v);
    }
    return result;
}

static void transform_camera(struct camera *camera, const mat4s *rotation,
                             const struct model_transform *model_transform)
{
    const vec3s up =
        glms_vec3_norm2(camera->up) > 0.0f ? camera->up : (vec3s){ { 0.0f, 1.0f, 0.0f } };
    camera->eye =
        glms_vec3_scale(rotated(rotation, model_transform, camera->eye), scale_of(model_transform));
    camera->target = glms_vec3_scale(rotated(rotation, model_transform, camera->target),
                                     scale_of(model_transform));
    camera->up = rotated(rotation, model_transform, up);
}

enum status model_transform_apply(struct model *model,
                                  const struct model_transform *model_transform, const char *path)
{
    const mat4s rotation = rotation_of(model_transform);
    const bool is_in_range = transform_mesh(&model->object, &rotation, model_transform) &&
                             transform_mesh(&model->surroundings, &rotation, model_transform);
    if (!is_in_range) {
        log_error("%s: --scale %g makes its coordinates larger than 1000000 metres", path,
                  (double)scale_of(model_transform));
        return STATUS_DATA;
    }
    transform_origin(model->origin, model_transform);
    if (model->has_camera)
        transform_camera(&model->camera, &rotation, model_transform);
    for (uint32_t i = 0; i < model->camera_count; i++) {
        transform_camera(&model->cameras[i].camera, &rotation, model_transform);
        model->cameras[i].height *= scale_of(model_transform);
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        struct light *light = &model->lights[i];
        light->position = glms_vec3_scale(rotated(&rotation, model_transform, light->position),
                                          scale_of(model_transform));
        light->direction = rotated(&rotation, model_transform, light->direction);
        light->range *= scale_of(model_transform);
    }
    if (model->has_box)
        model->box = transform_box(model->box, &rotation, model_transform);
    return STATUS_OK;
}
