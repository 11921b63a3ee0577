/* model_arrays.c: builds a model from meshes, materials and instances in memory. */
#include "src/scene/import/model_arrays.h"
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/importer.h"

struct building {
    const struct model_arrays *arrays;
    enum model_role default_role;
    bool is_split; /* the material decides the role; else default_role does */
    struct model_build build;
};

static struct model_shape shape_of(const struct model_arrays_mesh *mesh, const char *name)
{
    return (struct model_shape){
        .name = name,
        .positions = mesh->positions,
        .normals = mesh->normals,
        .uvs = mesh->uvs,
        .uv_stride = 2,
        .indices = mesh->indices,
        .vertex_count = mesh->vertex_count,
        .index_count = mesh->index_count,
        .color = glms_vec3_one(),
    };
}

enum status model_arrays_check(const struct model_arrays_mesh *mesh, const char *name)
{
    const struct model_import import = { .path = name };
    const struct model_shape shape = shape_of(mesh, "mesh");
    return model_shape_check(&import, &shape);
}

static const struct material *material_of(const struct building *b,
                                          const struct model_arrays_instance *instance)
{
    return instance->material >= 0 ? &b->arrays->materials[instance->material] : NULL;
}

static enum model_role role_of(const struct building *b,
                               const struct model_arrays_instance *instance)
{
    const struct material *material = material_of(b, instance);
    if (!b->is_split)
        return b->default_role;
    return material && material->transmission > 0 ? MODEL_OBJECT : MODEL_SURROUNDINGS;
}

static enum status count_instance(struct building *b, const struct model_arrays_instance *instance)
{
    const struct model_arrays_mesh *mesh = &b->arrays->meshes[instance->mesh];
    const enum model_role role = role_of(b, instance);
    model_build_extend(&b->build, role, mesh->positions, mesh->vertex_count,
                       &instance->world_from_mesh);
    return model_build_count(&b->build, role, mesh->vertex_count, mesh->index_count);
}

/* Adds an object for an instance, whose triangles must be appended to the mesh afterwards. */
static enum status add_object(struct building *b, uint32_t index)
{
    const struct model_arrays_instance *instance = &b->arrays->instances[index];
    const struct model_arrays_mesh *mesh = &b->arrays->meshes[instance->mesh];
    struct model *model = b->build.model;
    struct object object = {
        .index_count = mesh->index_count,
        .material = (uint32_t)instance->material,
    };
    const struct model_build_object params = {
        .group = index + 1,
        .vertex_count = mesh->vertex_count,
    };
    memcpy(object.name, instance->name, sizeof(object.name));
    if (!model->has_ior)
        model->ior = material_of(b, instance)->ior;
    model->has_ior = true;
    return model_build_add_object(&b->build, &object, &params);
}

static enum status add_instance(struct building *b, uint32_t index)
{
    const struct model_arrays_instance *instance = &b->arrays->instances[index];
    const struct material *material = material_of(b, instance);
    const struct affine world = affine_relocate(&instance->world_from_mesh, b->build.model->origin);
    const enum model_role role = role_of(b, instance);
    struct model_shape shape = shape_of(&b->arrays->meshes[instance->mesh], instance->name);
    enum status status = STATUS_OK;
    if (material && b->is_split) {
        shape.color = material->base_color;
        shape.material = ((uint32_t)instance->material + 1) << MESH_SURFACE_SHIFT |
                         (material->flags & MATERIAL_IS_UNLIT ? MESH_UNLIT : 0u);
        if (role == MODEL_OBJECT)
            status = add_object(b, index);
    }
    b->build.surroundings_name = instance->name;
    return status == STATUS_OK ? model_build_add(&b->build, role, &shape, &world) : status;
}

static enum status copy_materials(const struct building *b)
{
    const struct model_arrays *arrays = b->arrays;
    struct model *model = b->build.model;
    model->materials = calloc(arrays->material_count, sizeof(*model->materials));
    if (!model->materials)
        return log_out_of_memory(b->build.import->path);
    memcpy(model->materials, arrays->materials, arrays->material_count * sizeof(struct material));
    model->material_count = arrays->material_count;
    return STATUS_OK;
}

static enum status copy_lights(const struct building *b)
{
    const struct model_arrays *arrays = b->arrays;
    struct model *model = b->build.model;
    if (!arrays->light_count)
        return STATUS_OK;
    model->lights = calloc(arrays->light_count, sizeof(*model->lights));
    if (!model->lights)
        return log_out_of_memory(b->build.import->path);
    model->light_count = arrays->light_count;
    for (uint32_t i = 0; i < arrays->light_count; i++) {
        model->lights[i] = arrays->lights[i];
        for (int k = 0; k < 3; k++)
            model->lights[i].position.raw[k] =
                (float)((double)arrays->lights[i].position.raw[k] - model->origin[k]);
    }
    return STATUS_OK;
}

static enum status build_all(struct building *b)
{
    const uint32_t count = b->arrays->instance_count;
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++)
        status = count_instance(b, &b->arrays->instances[i]);
    if (status == STATUS_OK)
        status = model_build_allocate(&b->build);
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++)
        status = add_instance(b, i);
    if (status == STATUS_OK)
        status = b->is_split ? copy_materials(b) : model_build_default_object(&b->build);
    if (status == STATUS_OK)
        status = copy_lights(b);
    return status == STATUS_OK ? model_build_end(&b->build) : status;
}

enum status model_arrays_build(struct model *model, const struct model_arrays *arrays,
                               enum model_role default_role, const char *name)
{
    struct model_import import = { .path = name };
    struct building b = {
        .arrays = arrays,
        .default_role = default_role == MODEL_BY_MATERIALS ? MODEL_OBJECT : default_role,
    };
    *model = (struct model){ 0 };
    for (uint32_t i = 0; i < arrays->instance_count; i++) {
        const struct material *material = material_of(&b, &arrays->instances[i]);
        b.is_split |= material && (default_role != MODEL_OBJECT || material->transmission > 0);
    }
    if (!arrays->instance_count) {
        log_error("%s: expected at least one instance of a mesh", name);
        return STATUS_DATA;
    }
    if (arrays->material_count > MESH_SURFACE_MAX - 2) { /* as in glTF files */
        log_error("%s: expected at most %u materials", name, MESH_SURFACE_MAX - 2);
        return STATUS_DATA;
    }
    model_build_init(&b.build, &import, model);
    const enum status status = build_all(&b);
    model_build_finish(&b.build);
    if (status == STATUS_OK)
        model_build_warn(&import);
    else
        model_finish(model);
    return status;
}

void model_arrays_mesh_finish(struct model_arrays_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->uvs);
    free(mesh->indices);
    *mesh = (struct model_arrays_mesh){ 0 };
}

void model_arrays_finish(struct model_arrays *arrays)
{
    for (uint32_t i = 0; i < arrays->mesh_count; i++)
        model_arrays_mesh_finish(&arrays->meshes[i]);
    free(arrays->meshes);
    free(arrays->materials);
    free(arrays->instances);
    free(arrays->lights);
    *arrays = (struct model_arrays){ 0 };
}
