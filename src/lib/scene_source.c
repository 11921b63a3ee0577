/* scene_source.c: builds model and environment from arrays, and replaces materials of objects. */
#include "src/lib/scene_source.h"
#include <cglm/struct.h>
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

/* Returns `from` / `by`, or `other` where `by` is 0. */
static vec3s divide(vec3s from, vec3s by, vec3s other)
{
    vec3s result = other;
    for (int c = 0; c < 3; c++)
        result.raw[c] = by.raw[c] > 0.0f ? from.raw[c] / by.raw[c] : other.raw[c];
    return result;
}

/* Scales the colours of a refractive object's vertices, which contain its base colour, to another
 * base colour. */
static enum status recolor(struct model *model, const struct object *object, vec3s old, vec3s made)
{
    struct mesh *mesh = &model->object;
    uint8_t *is_done = calloc(mesh->vertex_count + (size_t)1, 1);
    if (!is_done)
        return log_out_of_memory("materials");
    for (uint32_t i = 0; i < object->index_count; i++) {
        const uint32_t vertex = mesh->indices[object->first_index + i];
        vec3s *color = &mesh->vertices[vertex].color;
        if (!is_done[vertex])
            *color = glms_vec3_mul(made, divide(*color, old, glms_vec3_one()));
        is_done[vertex] = 1;
    }
    free(is_done);
    return STATUS_OK;
}

/* Gives an object of the surroundings a new last material. Its vertices keep their colours relative
 * to the base colour. */
static enum status change_opaque(struct model *model, uint32_t part,
                                 const struct firn_material *change)
{
    const uint32_t end = part + 1 < model->surroundings_object_count
                             ? model->surroundings_starts[part + 1]
                             : model->surroundings.vertex_count;
    struct mesh_vertex *first = &model->surroundings.vertices[model->surroundings_starts[part]];
    struct mesh_vertex *last = &model->surroundings.vertices[end];
    const uint32_t number = first < last ? first->material >> MESH_SURFACE_SHIFT : 0;
    const struct material old = number ? model->materials[number - 1] : material_make("");
    struct material made = old;
    const enum status status = lib_material_read(&made, change);
    const uint32_t surface = (model->material_count + 1) << MESH_SURFACE_SHIFT;
    for (struct mesh_vertex *v = first; v < last && status == STATUS_OK; v++) {
        v->color =
            glms_vec3_mul(made.base_color, divide(v->color, old.base_color, glms_vec3_one()));
        v->material = (v->material & ((1u << MESH_SURFACE_SHIFT) - 1)) | surface;
    }
    model->materials[model->material_count++] = made;
    return status;
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
        const uint32_t part = change->object - model->object_count;
        if (change->object >= model->object_count) {
            const enum status status = part < model->surroundings_object_count
                                           ? change_opaque(model, part, &change->material)
                                           : STATUS_OK;
            if (status != STATUS_OK)
                return status;
            continue;
        }
        struct object *object = &model->objects[change->object];
        struct material made = grown[object->material];
        const vec3s old = made.base_color;
        enum status status = lib_material_read(&made, &change->material);
        if (status == STATUS_OK)
            status = recolor(model, object, old, made.base_color);
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
