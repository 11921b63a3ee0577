/* scene_material_queries.c: tests whether objects need more than the clear, white default material.
 */
#include <cglm/struct.h>
#include "src/scene/scene.h"

static bool is_lit(const struct material *m)
{
    return !(m->flags & MATERIAL_FROM_SETTINGS) &&
           (m->transmission < 1.0f || m->textures[MATERIAL_TRANSMISSION].layer);
}

bool scene_has_lit_object(const struct scene *scene)
{
    const struct model *model = &scene->model;
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (is_lit(&model->materials[model->objects[i].material]))
            return true;
    }
    for (uint32_t i = 0; i < model->material_count; i++) {
        if (model->materials[i].flags & MATERIAL_IS_PARTIAL && is_lit(&model->materials[i]))
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
