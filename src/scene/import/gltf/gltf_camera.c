/* gltf_camera.c: reads cameras and the environment lookup box from a glTF file. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/scene/import/gltf/gltf.h"

static bool is_in_range(vec3s vector)
{
    const float max = (float)MODEL_ORIGIN_MAX; /* comparisons with NaN are false */
    return fabsf(vector.x) <= max && fabsf(vector.y) <= max && fabsf(vector.z) <= max;
}

/* Sets eye and target. The target is along -Z of the node, as far away as the object's centre. */
static bool set_transform(struct camera *camera, mat4s model_from_node, const struct mesh *object)
{
    camera->eye = glms_mat4_mulv3(model_from_node, glms_vec3_zero(), 1);
    camera->up = glms_mat4_mulv3(model_from_node, (vec3s){ { 0, 1, 0 } }, 0);
    const vec3s forward = glms_mat4_mulv3(model_from_node, (vec3s){ { 0, 0, -1 } }, 0);
    if (!is_in_range(camera->eye) || !is_in_range(camera->up) || !is_in_range(forward) ||
        !(glms_vec3_norm(forward) > 0))
        return false;
    float distance = 0;
    if (object->vertex_count > 0)
        distance = glms_vec3_distance(box_center(mesh_box(object)), camera->eye);
    if (!(distance > 1e-5F * glms_vec3_norm(camera->eye)))
        distance = 1;
    camera->target =
        glms_vec3_add(camera->eye, glms_vec3_scale(glms_vec3_normalize(forward), distance));
    return true;
}

static bool read_camera(struct model_camera *camera, const struct gltf_object *object,
                        const struct gltf_node *node, const struct mesh *mesh)
{
    const struct gltf_object perspective = gltf_member(object, "perspective");
    const struct gltf_object orthographic = gltf_member(object, "orthographic");
    const char *camera_name = gltf_string(object, "name", "");
    (void)snprintf(camera->name, sizeof(camera->name), "%s",
                   node->name[0] ? node->name : camera_name);
    if (perspective.json || !orthographic.json) {
        camera->camera.fov_deg = glm_deg(gltf_number(&perspective, "yfov", 0));
        camera->aspect = gltf_number(&perspective, "aspectRatio", 0);
    } else {
        camera->kind = MODEL_ORTHOGRAPHIC;
        camera->camera.fov_deg = 45; /* unused, but keeps the camera valid */
        camera->height = 2 * fabsf(gltf_number(&orthographic, "ymag", 0));
        camera->aspect = 2 * fabsf(gltf_number(&orthographic, "xmag", 0)) / camera->height;
    }
    const bool is_valid = camera->kind == MODEL_PERSPECTIVE
                              ? camera->camera.fov_deg > 0 && camera->camera.fov_deg < 180
                              : camera->height > 0 && camera->height <= MODEL_COORDINATE_MAX;
    if (!(camera->aspect > 0 && camera->aspect <= MODEL_COORDINATE_MAX))
        camera->aspect = 0;
    return is_valid &&
           set_transform(&camera->camera,
                         affine_to_mat4(&node->model_from_node, object->gltf->origin), mesh);
}

static uint32_t count_cameras(const struct gltf *gltf)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < gltf->order_count; i++)
        count += gltf->nodes[gltf->order[i]].camera != gltf_none;
    return count;
}

enum status gltf_cameras_read(struct gltf *gltf, struct model *model)
{
    const struct gltf_object top = gltf_top(gltf);
    const uint32_t count = count_cameras(gltf);
    if (count > MODEL_CAMERA_MAX)
        return gltf_fault(&top, "expected at most %d cameras in the scene, got %u",
                          MODEL_CAMERA_MAX, count);
    model->cameras = calloc(count + (size_t)1, sizeof(*model->cameras));
    if (!model->cameras)
        return gltf_out_of_memory(gltf);
    for (uint32_t i = 0; i < gltf->order_count && gltf->status == STATUS_OK; i++) {
        const struct gltf_node *node = &gltf->nodes[gltf->order[i]];
        if (node->camera == gltf_none)
            continue;
        const struct gltf_object object = gltf_element(gltf, "cameras", node->camera);
        struct model_camera *camera = &model->cameras[model->camera_count++];
        if (!read_camera(camera, &object, node, &model->object))
            return gltf_fault(&object, "field of view or position out of range");
        if (camera->kind == MODEL_PERSPECTIVE && !model->has_camera) {
            model->has_camera = true;
            model->camera = camera->camera;
            model->camera_aspect = camera->aspect;
        }
    }
    return gltf->status;
}

/* ---- box in extras ---- */

static bool read_corner(const json_t *numbers, const double origin[static 3], vec3s *corner)
{
    bool is_valid_corner = json_is_array(numbers) && json_array_size(numbers) == 3;
    for (size_t k = 0; is_valid_corner && k < 3; k++) {
        const json_t *number = json_array_get(numbers, k);
        corner->raw[k] = (float)(json_number_value(number) - origin[k]);
        is_valid_corner =
            json_is_number(number) && fabsf(corner->raw[k]) <= (float)MODEL_COORDINATE_MAX;
    }
    return is_valid_corner;
}

static bool read_box(const json_t *corners, const double origin[static 3], struct box *box)
{
    return json_is_array(corners) && json_array_size(corners) == 2 &&
           read_corner(json_array_get(corners, 0), origin, &box->min) &&
           read_corner(json_array_get(corners, 1), origin, &box->max) && box->min.x < box->max.x &&
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
        if (!read_box(box, gltf->origin, &model->box))
            return gltf_fault(&object, "expected extras.firn.box as [[x,y,z],[x,y,z]], metres, "
                                       "minima before maxima");
        model->has_box = true;
        break;
    }
    return gltf->status;
}
