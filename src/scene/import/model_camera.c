/* model_camera.c: the camera of a model file. */
#include <math.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_import.h"

static const struct model_node *find_node(const struct model_import *import,
                                          const struct aiString *name)
{
    for (uint32_t i = 0; i < import->node_count; i++) {
        const struct aiString *other = &import->nodes[i].node->mName;
        if (other->length == name->length && memcmp(other->data, name->data, name->length) == 0)
            return &import->nodes[i];
    }
    return NULL;
}

static float vertical_fov(const struct model_import *import, const struct aiCamera *source)
{
    float aspect = source->mAspect > 0 ? source->mAspect : 1;
    /* For a glTF camera, the horizontal angle of assimp 5.2 is yfov times the aspect. */
    if (import->is_gltf)
        return source->mHorizontalFOV / aspect;
    return 2 * atanf(tanf(source->mHorizontalFOV / 2) / aspect);
}

static vec3s transform(mat4s matrix, struct aiVector3D vector, float w)
{
    return glms_mat4_mulv3(matrix, (vec3s){ { vector.x, vector.y, vector.z } }, w);
}

static bool is_sound(vec3s vector)
{
    const float max = MODEL_COORDINATE_MAX; /* comparisons with NaN are false */
    return fabsf(vector.x) <= max && fabsf(vector.y) <= max && fabsf(vector.z) <= max;
}

static bool fill(struct camera *camera, const struct model_import *import,
                 const struct aiCamera *source, const struct model_node *node,
                 const struct mesh *object)
{
    /* assimp 5.2 gives a glTF camera its node's position, which would be applied twice. */
    struct aiVector3D position = import->is_gltf ? (struct aiVector3D){ 0 } : source->mPosition;
    camera->eye = transform(node->model_from_node, position, 1);
    camera->up = transform(node->model_from_node, source->mUp, 0);
    vec3s ahead = transform(node->model_from_node, source->mLookAt, 0);
    camera->fov_deg = glm_deg(vertical_fov(import, source));
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

enum status model_camera_read(const struct model_import *import, struct model *model)
{
    for (uint32_t i = 0; i < import->scene->mNumCameras; i++) {
        const struct aiCamera *source = import->scene->mCameras[i];
        const struct model_node *node = find_node(import, &source->mName);
        if (!node || source->mOrthographicWidth > 0)
            continue;
        if (!fill(&model->camera, import, source, node, &model->object)) {
            log_error("%s: camera \"%s\": field of view or position out of range", import->path,
                      source->mName.data);
            return STATUS_DATA;
        }
        model->has_camera = true;
        return STATUS_OK;
    }
    return STATUS_OK;
}
