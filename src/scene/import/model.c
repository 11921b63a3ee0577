/* model.c: loads a model file of any format, and appends models to the surroundings of another. */
#include "src/scene/import/model.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/scene/import/importer.h"

static enum status check_file(const char *path)
{
    const struct file_info info = file_info_of(path);
    if (info.kind == FILE_MISSING || !file_is_readable(path)) {
        log_error("%s: %s", path, strerror(errno));
        return STATUS_NO_INPUT;
    }
    if (info.kind != FILE_REGULAR) {
        log_error("%s: not a regular file", path);
        return STATUS_NO_INPUT;
    }
    if (info.size == 0) {
        log_error("%s: expected a model, got an empty file", path);
        return STATUS_DATA;
    }
    return STATUS_OK;
}

static enum status refuse_names(const char *path, const char *animation)
{
    if (animation)
        log_error("%s: no animation has the name or number '%.64s': only glTF files have "
                  "animations",
                  path, animation);
    else
        log_error("%s: only glTF files have nodes: use "
                  "--material without a node name",
                  path);
    return STATUS_DATA;
}

enum status model_load_posed(struct model *model, const char *path, enum model_role default_role,
                             const struct model_pose *pose)
{
    struct model_import import = { .path = path, .origin = pose->origin };
    const struct model_format *format;
    *model = (struct model){ 0 };
    enum status status = check_file(path);
    if (status == STATUS_OK)
        status = model_format_find(path, &format);
    if (status != STATUS_OK)
        return status;
    if (format->is_gltf)
        status = model_load_gltf(&import, model, default_role, pose);
    else if (pose->animation || (pose->objects && pose->objects[0]))
        status = refuse_names(path, pose->animation);
    else
        status = model_load_obj_ply(&import, format->suffix, model, default_role);
    if (status == STATUS_OK)
        model_build_warn(&import);
    if (status == STATUS_OK)
        model_loss_warn(&import, model);
    else
        model_finish(model);
    return status;
}

enum status model_load(struct model *model, const char *path, enum model_role default_role)
{
    return model_load_posed(model, path, default_role, &(struct model_pose){ 0 });
}

static void offset_materials(struct mesh *mesh, uint32_t first_layer, uint32_t first_material)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        uint32_t *material = &mesh->vertices[i].material;
        if (*material & MESH_TEXTURE_MASK)
            *material += first_layer;
        if (*material >> MESH_SURFACE_SHIFT)
            *material += first_material << MESH_SURFACE_SHIFT;
    }
}

static void move_mesh(struct mesh *mesh, const double by[static 3])
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++)
            mesh->vertices[i].position.raw[k] =
                (float)((double)mesh->vertices[i].position.raw[k] + by[k]);
    }
}

/* Makes the positions of `other` that model_add_surroundings() takes relative to `origin`. */
static void change_origin(struct model *other, const double origin[static 3])
{
    double by[3];
    bool is_same = true;
    for (int k = 0; k < 3; k++) {
        by[k] = other->origin[k] - origin[k];
        is_same = is_same && fabs(by[k]) <= 0;
    }
    if (is_same)
        return;
    move_mesh(&other->object, by);
    move_mesh(&other->surroundings, by);
    for (int k = 0; k < 3; k++) {
        for (uint32_t i = 0; i < other->light_count; i++)
            other->lights[i].position.raw[k] =
                (float)((double)other->lights[i].position.raw[k] + by[k]);
        other->box.min.raw[k] = (float)((double)other->box.min.raw[k] + by[k]);
        other->box.max.raw[k] = (float)((double)other->box.max.raw[k] + by[k]);
    }
}

static enum status add_materials(struct model *model, const struct model *other)
{
    const size_t count = (size_t)model->material_count + other->material_count;
    if (count > MESH_SURFACE_MAX) {
        log_error("expected at most %u materials in all models together", MESH_SURFACE_MAX);
        return STATUS_DATA;
    }
    struct material *grown = realloc(model->materials, (count + 1) * sizeof(*grown));
    if (!grown)
        return log_out_of_memory("surroundings");
    model->materials = grown;
    for (uint32_t i = 0; i < other->material_count; i++) {
        struct material *material = &grown[model->material_count + i];
        *material = other->materials[i];
        for (uint32_t k = 0; k < MATERIAL_TEXTURE_COUNT; k++) {
            if (material->textures[k].layer > 0)
                material->textures[k].layer +=
                    material_texture_is_color(k) ? model->textures.count : model->numbers.count;
        }
    }
    return STATUS_OK;
}

static enum status add_lights(struct model *model, const struct model *other)
{
    const size_t count = (size_t)model->light_count + other->light_count;
    if (count > MODEL_LIGHT_MAX) {
        log_error("expected at most %d lights in all models together", MODEL_LIGHT_MAX);
        return STATUS_DATA;
    }
    struct light *grown = realloc(model->lights, (count + 1) * sizeof(*grown));
    if (!grown)
        return log_out_of_memory("surroundings");
    model->lights = grown;
    for (uint32_t i = 0; i < other->light_count; i++)
        grown[model->light_count + i] = other->lights[i];
    return STATUS_OK;
}

/* Appends all objects of `other`, including refractive ones, to the surroundings objects. Call this
 * before the meshes are appended. Vertices are numbered in order of first use. Therefore, each
 * object's first vertex is 1 + the highest index of all earlier objects. */
static bool add_surroundings_objects(struct model *model, const struct model *other)
{
    uint32_t first = model->surroundings.vertex_count, next = 0, index = 0;
    bool done = true;
    for (uint32_t i = 0; i < other->object_count && done; i++) {
        for (; index < other->objects[i].first_index; index++) {
            if (other->object.indices[index] >= next)
                next = other->object.indices[index] + 1;
        }
        done = model_surroundings_add_object(model, other->objects[i].name, first + next);
    }
    first += other->object.vertex_count;
    for (uint32_t i = 0; i < other->surroundings_object_count && done; i++)
        done = model_surroundings_add_object(model, other->surroundings_names[i],
                                             first + other->surroundings_starts[i]);
    return done;
}

enum status model_add_surroundings(struct model *model, struct model *other)
{
    const uint32_t surroundings_object_count = model->surroundings_object_count;
    struct texture_layers textures = { 0 }, numbers = { 0 };
    enum status status = model_texture_merge(&textures, &model->textures, &other->textures, false);
    if (status == STATUS_OK)
        status = model_texture_merge(&numbers, &model->numbers, &other->numbers, true);
    if (status != STATUS_OK)
        goto fail;
    status = add_materials(model, other);
    change_origin(other, model->origin);
    if (status == STATUS_OK)
        status = add_lights(model, other);
    if (status != STATUS_OK)
        goto fail;
    offset_materials(&other->object, model->textures.count, model->material_count);
    offset_materials(&other->surroundings, model->textures.count, model->material_count);
    if (!add_surroundings_objects(model, other) ||
        !mesh_append(&other->object, &other->surroundings) ||
        !mesh_append(&model->surroundings, &other->object)) {
        model->surroundings_object_count = surroundings_object_count;
        status = log_out_of_memory("surroundings");
        goto fail;
    }
    model->material_count += other->material_count;
    model->light_count += other->light_count;
    free(model->textures.texels);
    model->textures = textures;
    textures.texels = NULL;
    free(model->numbers.texels);
    model->numbers = numbers;
    numbers.texels = NULL;
    if (other->has_box) {
        model->has_box = true;
        model->box = other->box;
    }
fail:
    free(textures.texels);
    free(numbers.texels);
    model_finish(other);
    return status;
}

void model_finish(struct model *model)
{
    mesh_finish(&model->object);
    mesh_finish(&model->surroundings);
    free(model->objects);
    free(model->materials);
    free(model->surroundings_starts);
    free(model->surroundings_names);
    free(model->cameras);
    free(model->extensions);
    free(model->lights);
    free(model->animations);
    free(model->textures.texels);
    free(model->numbers.texels);
    *model = (struct model){ 0 };
}
