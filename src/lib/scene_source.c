/* scene_source.c: builds model and environment from arrays, and replaces materials of objects. */
#include "src/lib/scene_source.h"
#include <stdlib.h>
#include <string.h>

const char lib_environment_name[] = "array";

void lib_free_arrays(struct lib_arrays *arrays)
{
    if (!arrays)
        return;
    model_arrays_finish(&arrays->model);
    environment_finish(&arrays->environment);
    free(arrays);
}

static enum status make_model(void *user, struct model *model, enum model_role default_role)
{
    const firn_scene *scene = user;
    const struct lib_arrays none = { 0 };
    const struct lib_arrays *arrays = scene->arrays ? scene->arrays : &none;
    return model_arrays_build(model, &arrays->model, default_role, scene->given.scene.name);
}

static enum status make_environment(void *user, struct environment *environment)
{
    const firn_scene *scene = user;
    const struct environment *from = &scene->arrays->environment;
    const size_t size = (size_t)from->width * from->height * 4 * sizeof(*from->texels);
    *environment = *from;
    environment->texels = malloc(size);
    if (!environment->texels)
        return log_out_of_memory("environment");
    memcpy(environment->texels, from->texels, size);
    return STATUS_OK;
}

/* Applies the material changes. Each changed object gets a material of its own. */
static enum status change_materials(void *user, struct model *model)
{
    const firn_scene *scene = user;
    const uint32_t first = model->material_count, count = scene->change_count;
    if (first + count > MESH_SURFACE_MAX) {
        log_error("expected at most %u materials, including those of the model", MESH_SURFACE_MAX);
        return STATUS_DATA;
    }
    struct material *grown = realloc(model->materials, (first + (size_t)count) * sizeof(*grown));
    if (!grown)
        return log_out_of_memory("materials");
    model->materials = grown;
    for (uint32_t i = 0; i < count; i++) {
        const struct lib_material_change *change = &scene->changes[i];
        if (change->object >= model->object_count)
            continue;
        struct object *object = &model->objects[change->object];
        struct material made = grown[object->material];
        const enum status status = lib_material_read(&made, &change->material);
        if (status != STATUS_OK)
            return status;
        grown[model->material_count] = made;
        object->material = model->material_count++;
        if (change->object == 0)
            model->ior = made.ior;
    }
    return STATUS_OK;
}

void lib_set_source(firn_scene *scene)
{
    const bool has_environment = scene->given.scene.environment == lib_environment_name;
    scene->source = (struct scene_source){
        .make_model = scene->is_arrays ? make_model : NULL,
        .make_environment = has_environment ? make_environment : NULL,
        .change_materials = scene->change_count ? change_materials : NULL,
        .user = scene,
    };
}
