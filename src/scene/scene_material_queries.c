/* scene_material_queries.c: tests whether objects need more than the clear, white default material.
 */
#include <cglm/struct.h>
#include "src/scene/scene.h"

bool scene_has_lit_object(const struct scene *scene)
{
    const struct model *model = &scene->model;
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct material *m = &model->materials[model->objects[i].material];
        if (!(m->flags & MATERIAL_FROM_SETTINGS) &&
            (m->transmission < 1.0f || m->textures[MATERIAL_TRANSMISSION].layer))
            return true;
    }
    return false;
}

bool scene_has_textured_objects(const struct scene *scene)
{
    const struct model *model = &scene->model;
    for (uint32_t i = 0; i < model->object_count && !scene->has_pool; i++) {
        const struct material *m = &model->materials[model->objects[i].material];
        if (!(m->flags & MATERIAL_FROM_SETTINGS) &&
            (m->transmission < 1.0f || material_is_textured(m) ||
             !glms_vec3_eqv(m->base_color, glms_vec3_one())))
            return true;
    }
    return false;
}
