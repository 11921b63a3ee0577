/* place.c: turns and scales a model as it is loaded. */
#include "src/scene/place.h"
#include <cglm/struct.h>
#include <math.h>
#include "src/base/log.h"

static const float most = 1e6f; /* metres, as of files */

static mat4s turn_of(const struct place *place)
{
    const float degree = 0.01745329252f;
    mat4s turn = glms_mat4_identity();
    turn = glms_rotate(turn, place->rotate_deg.z * degree, (vec3s){ { 0.0f, 0.0f, 1.0f } });
    turn = glms_rotate(turn, place->rotate_deg.y * degree, (vec3s){ { 0.0f, 1.0f, 0.0f } });
    turn = glms_rotate(turn, place->rotate_deg.x * degree, (vec3s){ { 1.0f, 0.0f, 0.0f } });
    return turn;
}

static vec3s turned(const mat4s *turn, const struct place *place, vec3s v)
{
    const vec3s upright = place->is_z_up ? (vec3s){ { v.x, v.z, -v.y } } : v;
    return glms_mat4_mulv3(*turn, upright, 0.0f);
}

static float scale_of(const struct place *place)
{
    return place->scale > 0.0f ? place->scale : 1.0f;
}

static bool place_mesh(struct mesh *mesh, const mat4s *turn, const struct place *place)
{
    bool is_near = true;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        struct mesh_vertex *vertex = &mesh->vertices[i];
        vertex->position = glms_vec3_scale(turned(turn, place, vertex->position), scale_of(place));
        vertex->normal = turned(turn, place, vertex->normal);
        if (mesh->extras) {
            vec3s *tangent = &mesh->extras[i].tangent;
            *tangent = turned(turn, place, *tangent);
        }
        for (int c = 0; c < 3; c++)
            is_near = is_near && fabsf(vertex->position.raw[c]) <= most;
    }
    return is_near;
}

/* The box around the corners of the old one. */
static struct box place_box(struct box box, const mat4s *turn, const struct place *place)
{
    struct box result = { { { INFINITY, INFINITY, INFINITY } },
                          { { -INFINITY, -INFINITY, -INFINITY } } };
    for (int corner = 0; corner < 8; corner++) {
        vec3s v = { { corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z } };
        v = glms_vec3_scale(turned(turn, place, v), scale_of(place));
        result.min = glms_vec3_minv(result.min, v);
        result.max = glms_vec3_maxv(result.max, v);
    }
    return result;
}

static void place_camera(struct camera *camera, const mat4s *turn, const struct place *place)
{
    const vec3s up =
        glms_vec3_norm2(camera->up) > 0.0f ? camera->up : (vec3s){ { 0.0f, 1.0f, 0.0f } };
    camera->eye = glms_vec3_scale(turned(turn, place, camera->eye), scale_of(place));
    camera->target = glms_vec3_scale(turned(turn, place, camera->target), scale_of(place));
    camera->up = turned(turn, place, up);
}

enum status place_model(struct model *model, const struct place *place, const char *path)
{
    const mat4s turn = turn_of(place);
    const bool is_near =
        place_mesh(&model->object, &turn, place) && place_mesh(&model->surroundings, &turn, place);
    if (!is_near) {
        log_error("%s: --scale %g makes its coordinates larger than 1000000 metres", path,
                  (double)scale_of(place));
        return STATUS_DATA;
    }
    if (model->has_camera)
        place_camera(&model->camera, &turn, place);
    for (uint32_t i = 0; i < model->camera_count; i++) {
        place_camera(&model->cameras[i].camera, &turn, place);
        model->cameras[i].height *= scale_of(place);
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        struct light *light = &model->lights[i];
        light->position = glms_vec3_scale(turned(&turn, place, light->position), scale_of(place));
        light->direction = turned(&turn, place, light->direction);
        light->range *= scale_of(place);
    }
    if (model->has_box)
        model->box = place_box(model->box, &turn, place);
    return STATUS_OK;
}
