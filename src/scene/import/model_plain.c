/* model_plain.c: converts the contents of an OBJ or PLY file to a model. */
#include "src/scene/import/model_plain.h"
#include <cglm/struct.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include "src/base/log.h"

void *plain_array_grow(struct plain_array *array, size_t count, size_t item_size)
{
    size_t capacity = array->room > 0 ? array->room : 64;
    while (capacity - array->count < count) {
        if (capacity > SIZE_MAX / 2 / item_size)
            return NULL;
        capacity *= 2;
    }
    void *items = realloc(array->items, capacity * item_size);
    if (!items)
        return NULL;
    array->items = items;
    array->room = capacity;
    array->count += count;
    return (char *)items + (array->count - count) * item_size;
}

char *plain_read_file(struct model_import *import, const char *path, size_t *size, bool *is_found)
{
    struct stat info;
    FILE *file = model_file_open(import, path);
    char *bytes = NULL;
    *is_found = file && fstat(fileno(file), &info) == 0;
    if (!*is_found) {
        if (file)
            fclose(file);
        return NULL;
    }
    const size_t size_max = info.st_size > 0 ? (size_t)info.st_size : 0;
    bytes = malloc(size_max + 1);
    if (bytes) {
        *size = fread(bytes, 1, size_max, file);
        bytes[*size] = '\0';
    } else {
        (void)log_out_of_memory(path);
    }
    if (bytes && ferror(file)) {
        log_error("%s: %s", path, strerror(errno));
        free(bytes);
        bytes = NULL;
    }
    fclose(file);
    return bytes;
}

/* ---- meshes ---- */

static const struct plain_material *material_of(const struct plain *plain,
                                                const struct plain_part *part)
{
    return part->material > 0 ? &plain->materials[part->material - 1] : NULL;
}

static struct model_shape make_shape(const struct plain *plain, const struct plain_part *part,
                                     char name[static 80])
{
    const struct plain_material *material = material_of(plain, part);
    const size_t first = part->first_vertex;
    const bool is_unlit = plain->colors && !plain->normals && !material;
    const uint32_t layer =
        material && part->has_uvs ? material->material.textures[MATERIAL_BASE_COLOR].layer : 0;
    (void)snprintf(name, 80, "mesh %u \"%.40s\"", (unsigned)(part - plain->parts), part->name);
    return (struct model_shape){
        .name = name,
        .positions = &plain->positions[3 * first],
        .normals = plain->normals ? &plain->normals[3 * first] : NULL,
        .colors = plain->colors ? &plain->colors[4 * first] : NULL,
        .uvs = part->has_uvs ? &plain->uvs[2 * first] : NULL,
        .uv_stride = 2,
        .is_flipped = true,
        .indices = &plain->indices[part->first_index],
        .vertex_count = part->vertex_count,
        .index_count = part->index_count,
        .color = material ? material->color : glms_vec3_one(),
        .material = layer | (is_unlit ? MESH_UNLIT : 0u),
    };
}

/* Rule that assigns the parts of a file to refractive objects and surroundings. */
struct role_rule {
    enum model_part everything_is;
    bool is_split; /* by material; else everything_is applies */
};

static struct role_rule choose_roles(const struct plain *plain, enum model_part everything_is)
{
    struct role_rule role_rule = {
        .everything_is = everything_is == MODEL_BY_MATERIALS ? MODEL_OBJECT : everything_is,
    };
    for (uint32_t i = 0; i < plain->part_count; i++) {
        const struct plain_material *material = material_of(plain, &plain->parts[i]);
        if (plain->parts[i].index_count > 0 && material)
            role_rule.is_split |=
                everything_is != MODEL_OBJECT || material->material.transmission > 0;
    }
    return role_rule;
}

/* Returns the index of a part's material in the model; parts without one use the last material. */
static uint32_t material_index(const struct plain *plain, const struct plain_part *part)
{
    return part->material > 0 ? part->material - 1 : plain->material_count;
}

/* Adds the object of a part, before its triangles are appended to the object mesh. */
static enum status add_object(struct model_build *build, const struct plain *plain,
                              const struct plain_part *part)
{
    struct model *model = build->model;
    struct object *grown =
        realloc(model->objects, (model->object_count + (size_t)1) * sizeof(*grown));
    if (!grown)
        return log_out_of_memory(plain->import->path);
    model->objects = grown;
    struct object *object = &grown[model->object_count++];
    *object = (struct object){
        .first_index = (uint32_t)build->index_count[MODEL_OBJECT],
        .index_count = part->index_count,
        .material = material_index(plain, part),
    };
    memcpy(object->name, part->name, sizeof(object->name));
    model->has_ior = true;
    if (model->object_count == 1)
        model->ior = material_of(plain, part)->material.ior;
    return STATUS_OK;
}

static enum status list_materials(const struct plain *plain, struct model *model)
{
    const uint32_t count = plain->material_count + 1;
    if (count > MESH_SURFACE_MAX) {
        log_error("%s: expected at most %u materials, got %u", plain->import->path,
                  MESH_SURFACE_MAX, count);
        return STATUS_DATA;
    }
    model->materials = calloc(count, sizeof(*model->materials));
    if (!model->materials)
        return log_out_of_memory(plain->import->path);
    for (uint32_t i = 0; i < plain->material_count; i++) {
        struct material *m = &model->materials[i];
        *m = plain->materials[i].material;
        if (m->transmission > 0) /* tinted by Tf, not by map_Kd */
            m->textures[MATERIAL_BASE_COLOR].layer = 0;
    }
    model->materials[plain->material_count] = material_make("");
    model->material_count = count;
    for (uint32_t i = 0; i < plain->part_count; i++) {
        if (plain->parts[i].index_count > 0 && plain->parts[i].material == 0)
            return STATUS_OK;
    }
    model->material_count--; /* no part uses the last material */
    return STATUS_OK;
}

/* Visits all parts that have triangles: counts them in the first pass, adds them in the second. */
static enum status visit_parts(struct model_build *build, const struct plain *plain,
                               const struct role_rule *role_rule, bool is_counting)
{
    enum status status = STATUS_OK;
    const char *last = NULL; /* name of the previous part: equal names continue an object */
    for (uint32_t i = 0; i < plain->part_count && status == STATUS_OK; i++) {
        const struct plain_part *part = &plain->parts[i];
        const struct plain_material *material = material_of(plain, part);
        const bool is_clear = material && material->material.transmission > 0;
        const enum model_part role = !role_rule->is_split ? role_rule->everything_is
                                     : is_clear           ? MODEL_OBJECT
                                                          : MODEL_SURROUNDINGS;
        char name[80];
        if (part->index_count == 0)
            continue;
        struct model_shape shape = make_shape(plain, part, name);
        if (is_counting) {
            status = model_shape_check(plain->import, &shape);
            if (status == STATUS_OK)
                status = model_build_count(build, role, part->vertex_count, part->index_count);
            continue;
        }
        if (role_rule->is_split)
            shape.material |= (material_index(plain, part) + 1) << MESH_SURFACE_SHIFT;
        if (role_rule->is_split && role == MODEL_OBJECT)
            status = add_object(build, plain, part);
        if (!last || strcmp(last, part->name) != 0)
            build->opaque = part->name;
        last = part->name;
        if (status == STATUS_OK)
            status = model_build_add(build, role, &shape, glms_mat4_identity());
    }
    return status;
}

enum status plain_build(struct plain *plain, struct model *model, enum model_part everything_is)
{
    struct model_build build;
    const struct role_rule role_rule = choose_roles(plain, everything_is);
    model_build_init(&build, plain->import, model);
    enum status status = visit_parts(&build, plain, &role_rule, true);
    if (status == STATUS_OK)
        status = plain_load_pictures(plain, model);
    if (status == STATUS_OK)
        status = model_build_allocate(&build);
    if (status == STATUS_OK)
        status = visit_parts(&build, plain, &role_rule, false);
    if (status == STATUS_OK)
        status =
            role_rule.is_split ? list_materials(plain, model) : model_build_bare_object(&build);
    return status == STATUS_OK ? model_build_end(&build) : status;
}

void plain_finish(struct plain *plain)
{
    free(plain->positions);
    free(plain->normals);
    free(plain->colors);
    free(plain->uvs);
    free(plain->indices);
    free(plain->parts);
    for (uint32_t i = 0; i < plain->material_count; i++) {
        free(plain->materials[i].name);
        for (int k = 0; k < PLAIN_MAP_COUNT; k++)
            free(plain->materials[i].maps[k].file);
    }
    free(plain->materials);
    *plain = (struct plain){ .import = plain->import };
}
