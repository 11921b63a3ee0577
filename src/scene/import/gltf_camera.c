/* gltf_camera.c: the camera of a glTF file, and the box around its object. */
#include <math.h>
#include <string.h>
#include "src/scene/import/gltf.h"

static bool is_sound(vec3s vector)
{
    const float max = MODEL_COORDINATE_MAX; /* comparisons with NaN are false */
    return fabsf(vector.x) <= max && fabsf(vector.y) <= max && fabsf(vector.z) <= max;
}

static bool fill(struct camera *camera, mat4s model_from_node, float yfov,
                 const struct mesh *object)
{
    camera->eye = glms_mat4_mulv3(model_from_node, glms_vec3_zero(), 1);
    camera->up = glms_mat4_mulv3(model_from_node, (vec3s){ { 0, 1, 0 } }, 0);
    const vec3s ahead = glms_mat4_mulv3(model_from_node, (vec3s){ { 0, 0, -1 } }, 0);
    camera->fov_deg = glm_deg(yfov);
    if (!is_sound(camera->eye) || !is_sound(camera->up) || !is_sound(ahead) ||
        !(glms_vec3_norm(ahead) > 0) || !(camera->fov_deg > 0 && camera->fov_deg < 180))
        return false;
    float distance = 0;
    if (object->vertex_count > 0)
        distance = glms_vec3_distance(box_center(mesh_box(object)), camera->eye);
    if (!(distance > 1e-5F * glms_vec3_norm(camera->eye)))
        distance = 1;
    camera->target =
        glms_vec3_add(camera->eye, glms_vec3_scale(glms_vec3_normalize(ahead), distance));
    return true;
}

enum status gltf_camera_read(struct gltf *gltf, struct model *model)
{
    for (uint32_t i = 0; i < gltf->order_count && !model->has_camera; i++) {
        const struct gltf_node *node = &gltf->nodes[gltf->order[i]];
        if (node->camera == gltf_none)
            continue;
        const struct gltf_object object = gltf_element(gltf, "cameras", node->camera);
        const struct gltf_object perspective = gltf_member(&object, "perspective");
        if (!perspective.json) {
            gltf->undrawn |= 1u << GLTF_ORTHOGRAPHIC;
            continue;
        }
        const float yfov = gltf_number(&perspective, "yfov", 0);
        if (!fill(&model->camera, node->model_from_node, yfov, &model->object))
            return gltf_fault(&object, "field of view or position out of range");
        model->has_camera = true;
    }
    return gltf->status;
}

/* ---- "extras": { "firn": { "box": [[-3, 0, -4], [3, 2.5, 4]] } } ---- */

static bool read_corner(const json_t *numbers, vec3s *corner)
{
    bool is_good = json_is_array(numbers) && json_array_size(numbers) == 3;
    for (size_t k = 0; is_good && k < 3; k++) {
        const json_t *number = json_array_get(numbers, k);
        corner->raw[k] = (float)json_number_value(number);
        is_good = json_is_number(number) && fabsf(corner->raw[k]) <= (float)MODEL_COORDINATE_MAX;
    }
    return is_good;
}

static bool read_box(const json_t *corners, struct box *box)
{
    return json_is_array(corners) && json_array_size(corners) == 2 &&
           read_corner(json_array_get(corners, 0), &box->min) &&
           read_corner(json_array_get(corners, 1), &box->max) && box->min.x < box->max.x &&
           box->min.y < box->max.y && box->min.z < box->max.z;
}

enum status gltf_box_read(struct gltf *gltf, struct model *model)
{
    for (uint32_t i = 0; i < gltf->order_count; i++) {
        const struct gltf_object object = gltf_element(gltf, "nodes", gltf->order[i]);
        const json_t *extras = json_object_get(object.json, "extras");
        const json_t *box = json_object_get(json_object_get(extras, "firn"), "box");
        if (!box)
            continue;
        if (!read_box(box, &model->box))
            return gltf_fault(&object, "expected extras.firn.box as [[x,y,z],[x,y,z]], metres, "
                                       "minima before maxima");
        model->has_box = true;
        break;
    }
    return gltf->status;
}
