/* material_override.c: adds user-defined materials to a model, and assigns them to its objects. */
#include "src/scene/material_override.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"

char *material_override_names(const struct material_override *all, uint32_t count)
{
    char *lines = calloc(count + (size_t)1, MATERIAL_NAME_SIZE);
    size_t length = 0;
    for (uint32_t i = 0; i < count && lines; i++) {
        const size_t size = strlen(all[i].name);
        memcpy(&lines[length], all[i].name, size);
        lines[length + size] = '\n';
        length += size + 1;
    }
    return lines;
}

static bool has_node(const struct model *model, const char *name)
{
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (!strcmp(model->objects[i].name, name))
            return true;
    }
    return false;
}

/* Assigns material `first` + i to the objects that all[i].name matches. */
static void assign(struct model *model, const struct material_override *all, uint32_t count,
                   uint32_t first)
{
    for (uint32_t i = 0; i < count; i++) {
        const bool is_node = has_node(model, all[i].name);
        for (uint32_t k = 0; k < model->object_count; k++) {
            struct object *object = &model->objects[k];
            const char *name = is_node ? object->name : model->materials[object->material].name;
            if (!strcmp(name, all[i].name))
                object->material = first + i;
        }
    }
}

enum status material_override_apply(struct model *model, const struct material_override *all,
                                    uint32_t count)
{
    const uint32_t first = model->material_count;
    if (!count || !model->object_count)
        return STATUS_OK;
    if (first + count > MESH_SURFACE_MAX) {
        log_error("--material: expected at most %u materials, including those of the model; leave "
                  "some out",
                  MESH_SURFACE_MAX);
        return STATUS_DATA;
    }
    struct material *grown = realloc(model->materials, (first + (size_t)count) * sizeof(*grown));
    if (!grown)
        return log_out_of_memory("--material");
    model->materials = grown;
    for (uint32_t i = 0; i < count; i++)
        grown[first + i] = all[i].material;
    model->material_count += count;
    assign(model, all, count, first);
    model->has_ior = true;
    model->ior = grown[model->objects[0].material].ior;
    return STATUS_OK;
}
