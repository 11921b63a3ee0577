/* obj_ply_build.c: converts the contents of an OBJ or PLY file to a model, and warns about what is
 * not drawn. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/obj_ply.h"

/* ---- meshes ---- */

static const struct mtl_material *material_of(const struct obj_ply *obj_ply,
                                              const struct obj_ply_part *part)
{
    return part->material > 0 ? &obj_ply->materials[part->material - 1] : NULL;
}

static struct model_shape make_shape(const struct obj_ply *obj_ply, const struct obj_ply_part *part,
                                     char name[static 80])
{
    const struct mtl_material *material = material_of(obj_ply, part);
    const size_t first = part->first_vertex;
    const bool is_unlit = obj_ply->colors && !obj_ply->normals && !material;
    const uint32_t layer =
        material && part->has_uvs ? material->material.textures[MATERIAL_BASE_COLOR].layer : 0;
    (void)snprintf(name, 80, "mesh %u \"%.40s\"", (unsigned)(part - obj_ply->parts), part->name);
    return (struct model_shape){
        .name = name,
        .positions = &obj_ply->positions[3 * first],
        .normals = obj_ply->normals ? &obj_ply->normals[3 * first] : NULL,
        .colors = obj_ply->colors ? &obj_ply->colors[4 * first] : NULL,
        .uvs = part->has_uvs ? &obj_ply->uvs[2 * first] : NULL,
        .uv_stride = 2,
        .is_flipped = true,
        .indices = &obj_ply->indices[part->first_index],
        .vertex_count = part->vertex_count,
        .index_count = part->index_count,
        .color = material ? material->color : glms_vec3_one(),
        .material = layer | (is_unlit ? MESH_UNLIT : 0u),
    };
}

/* Rule that assigns the parts of a file to refractive objects and surroundings. */
struct role_rule {
    enum model_role default_role;
    bool is_split; /* roles by material; else default_role applies */
};

static struct role_rule choose_roles(const struct obj_ply *obj_ply, enum model_role default_role)
{
    struct role_rule role_rule = {
        .default_role = default_role == MODEL_BY_MATERIALS ? MODEL_OBJECT : default_role,
    };
    for (uint32_t i = 0; i < obj_ply->part_count; i++) {
        const struct mtl_material *material = material_of(obj_ply, &obj_ply->parts[i]);
        if (obj_ply->parts[i].index_count > 0 && material)
            role_rule.is_split |=
                default_role != MODEL_OBJECT || material->material.transmission > 0;
    }
    return role_rule;
}

/* Returns the model's index of a part's material, or of the last material if the part has none. */
static uint32_t material_index(const struct obj_ply *obj_ply, const struct obj_ply_part *part)
{
    return part->material > 0 ? part->material - 1 : obj_ply->material_count;
}

/* Adds an object for a part, whose triangles must be appended to the object mesh afterwards. */
static enum status add_object(struct model_build *build, const struct obj_ply *obj_ply,
                              const struct obj_ply_part *part)
{
    struct model *model = build->model;
    struct object object = {
        .index_count = part->index_count,
        .material = material_index(obj_ply, part),
    };
    const struct model_build_object params = {
        .group = (uint32_t)(part - obj_ply->parts) + 1,
        .vertex_count = part->vertex_count,
    };
    memcpy(object.name, part->name, sizeof(object.name));
    const enum status status = model_build_add_object(build, &object, &params);
    if (status != STATUS_OK)
        return status;
    model->has_ior = true;
    if (model->object_count == 1)
        model->ior = material_of(obj_ply, part)->material.ior;
    return STATUS_OK;
}

static enum status list_materials(const struct obj_ply *obj_ply, struct model *model)
{
    const uint32_t count = obj_ply->material_count + 1;
    if (count > MESH_SURFACE_MAX) {
        log_error("%s: expected at most %u materials, got %u", obj_ply->import->path,
                  MESH_SURFACE_MAX, count);
        return STATUS_DATA;
    }
    model->materials = calloc(count, sizeof(*model->materials));
    if (!model->materials)
        return log_out_of_memory(obj_ply->import->path);
    for (uint32_t i = 0; i < obj_ply->material_count; i++) {
        struct material *m = &model->materials[i];
        *m = obj_ply->materials[i].material;
        if (m->transmission > 0) /* tinted by Tf, not by map_Kd */
            m->textures[MATERIAL_BASE_COLOR].layer = 0;
    }
    model->materials[obj_ply->material_count] = material_make("");
    model->material_count = count;
    for (uint32_t i = 0; i < obj_ply->part_count; i++) {
        if (obj_ply->parts[i].index_count > 0 && obj_ply->parts[i].material == 0)
            return STATUS_OK;
    }
    model->material_count--; /* drops the unused last material */
    return STATUS_OK;
}

/* Counts a part's vertices and triangles, after checking them. */
static enum status count_part(struct model_build *build, const struct obj_ply *obj_ply,
                              const struct model_shape *shape, enum model_role role)
{
    const struct affine in_file = affine_identity();
    const enum status status = model_shape_check(obj_ply->import, shape);
    if (status != STATUS_OK)
        return status;
    model_build_extend(build, role, shape->positions, shape->vertex_count, &in_file);
    return model_build_count(build, role, shape->vertex_count, shape->index_count);
}

/* Visits all parts that have triangles: counts them in the first pass, adds them in the second. */
static enum status visit_parts(struct model_build *build, const struct obj_ply *obj_ply,
                               const struct role_rule *role_rule, bool is_counting)
{
    enum status status = STATUS_OK;
    const struct affine in_file = affine_identity();
    const struct affine from_origin = affine_relocate(&in_file, build->model->origin);
    const char *last = NULL; /* previous part's name */
    for (uint32_t i = 0; i < obj_ply->part_count && status == STATUS_OK; i++) {
        const struct obj_ply_part *part = &obj_ply->parts[i];
        const struct mtl_material *material = material_of(obj_ply, part);
        const bool is_clear = material && material->material.transmission > 0;
        const enum model_role role = !role_rule->is_split ? role_rule->default_role
                                     : is_clear           ? MODEL_OBJECT
                                                          : MODEL_SURROUNDINGS;
        char name[80];
        if (part->index_count == 0)
            continue;
        struct model_shape shape = make_shape(obj_ply, part, name);
        if (is_counting) {
            status = count_part(build, obj_ply, &shape, role);
            continue;
        }
        if (role_rule->is_split)
            shape.material |= (material_index(obj_ply, part) + 1) << MESH_SURFACE_SHIFT;
        if (role_rule->is_split && role == MODEL_OBJECT)
            status = add_object(build, obj_ply, part);
        if (!last || strcmp(last, part->name) != 0)
            build->surroundings_name = part->name;
        last = part->name;
        if (status == STATUS_OK)
            status = model_build_add(build, role, &shape, &from_origin);
    }
    return status;
}

static enum status build_model(struct obj_ply *obj_ply, struct model *model,
                               enum model_role default_role)
{
    struct model_build build;
    const struct role_rule role_rule = choose_roles(obj_ply, default_role);
    model_build_init(&build, obj_ply->import, model);
    enum status status = visit_parts(&build, obj_ply, &role_rule, true);
    if (status == STATUS_OK)
        status = mtl_textures_load(obj_ply, model);
    if (status == STATUS_OK)
        status = model_build_allocate(&build);
    if (status == STATUS_OK)
        status = visit_parts(&build, obj_ply, &role_rule, false);
    if (status == STATUS_OK)
        status = role_rule.is_split ? list_materials(obj_ply, model)
                                    : model_build_default_object(&build);
    if (status == STATUS_OK)
        status = model_build_end(&build);
    model_build_finish(&build);
    return status;
}

static void finish(struct obj_ply *obj_ply)
{
    free(obj_ply->positions);
    free(obj_ply->normals);
    free(obj_ply->colors);
    free(obj_ply->uvs);
    free(obj_ply->indices);
    free(obj_ply->parts);
    for (uint32_t i = 0; i < obj_ply->material_count; i++) {
        free(obj_ply->materials[i].name);
        for (int k = 0; k < MTL_MAP_COUNT; k++)
            free(obj_ply->materials[i].maps[k].file);
    }
    free(obj_ply->materials);
    *obj_ply = (struct obj_ply){ .import = obj_ply->import };
}

/* ---- the whole file ---- */

static void warn(const struct model_import *import, const char *of_what, const char *list)
{
    char text[2 * OBJ_PLY_LIST_SIZE];
    size_t length = 0;
    for (; *list; list += strcspn(list, "\n") + 1)
        length += (size_t)snprintf(&text[length], sizeof(text) - length, "%s%.*s",
                                   length > 0 ? ", " : "", (int)strcspn(list, "\n"), list);
    if (length > 0)
        log_warning("%s: not drawn%s: %s", import->path, of_what, text);
}

static enum status refuse_outside(const struct model_import *import)
{
    log_error("%s: refers to %s: expected only files within the model's folder", import->path,
              import->refused_file);
    return STATUS_DATA;
}

static enum status warn_of_missing(const struct model_import *import)
{
    char *path = model_file_join(import->path, import->missing_file);
    if (!path)
        return log_out_of_memory(import->path);
    log_warning("%s: refers to %s: %s; its materials are left out", import->path,
                import->missing_file, model_file_fault(path));
    free(path);
    return STATUS_OK;
}

enum status model_load_obj_ply(struct model_import *import, const char *suffix, struct model *model,
                               enum model_role default_role)
{
    struct obj_ply obj_ply = { .import = import };
    enum status status = strcmp(suffix, "ply") == 0   ? ply_read(&obj_ply)
                         : strcmp(suffix, "stl") == 0 ? stl_read(&obj_ply)
                                                      : obj_read(&obj_ply);
    if (status == STATUS_OK && import->refused_file[0])
        status = refuse_outside(import);
    if (status == STATUS_OK)
        status = build_model(&obj_ply, model, default_role);
    if (obj_ply.colors && obj_ply.material_count == 0 && default_role == MODEL_BY_MATERIALS)
        obj_ply_note_undrawn(obj_ply.undrawn, "vertex colours"); /* ice shows no vertex colours */
    if (status == STATUS_OK && import->missing_file[0])
        status = warn_of_missing(import);
    if (status == STATUS_OK) {
        warn(import, " of its materials", obj_ply.undrawn_materials);
        warn(import, "", obj_ply.undrawn);
        (void)snprintf(model->undrawn_text, sizeof(model->undrawn_text), "%s%s",
                       obj_ply.undrawn_materials, obj_ply.undrawn);
    }
    finish(&obj_ply);
    return status;
}
