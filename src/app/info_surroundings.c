/* info_surroundings.c: lists a model's opaque objects with their materials, for firn info. */
#include "src/app/info_surroundings.h"
#include <stdio.h>
#include <stdlib.h>
#include "src/file/json_text.h"

enum {
    MATERIALS_LISTED = 8, /* maximum materials of an object that are listed */
};

struct surroundings_object {
    uint32_t triangle_count;
    uint32_t material_count; /* MATERIALS_LISTED + 1 if there are more */
    uint32_t materials[MATERIALS_LISTED + 1];
};

static void add_material(struct surroundings_object *object, uint32_t material)
{
    for (uint32_t i = object->material_count; i-- > 0;) {
        if (object->materials[i] == material)
            return;
    }
    if (object->material_count <= MATERIALS_LISTED)
        object->materials[object->material_count++] = material;
}

/* Returns an entry for each surroundings object, or NULL when out of memory. The caller frees the
 * array. */
static struct surroundings_object *list_objects(const struct model *model)
{
    const struct mesh *mesh = &model->surroundings;
    struct surroundings_object *all =
        calloc(model->surroundings_object_count + (size_t)1, sizeof(*all));
    for (uint32_t i = 0; all && i < mesh->index_count; i += 3) {
        const uint32_t object = model_surroundings_find_object(model, mesh->indices[i]);
        const uint32_t material = mesh->vertices[mesh->indices[i]].material >> MESH_SURFACE_SHIFT;
        if (object == 0)
            continue;
        all[object - 1].triangle_count++;
        if (material > 0 && material <= model->material_count)
            add_material(&all[object - 1], material - 1);
    }
    return all;
}

void info_surroundings_print(const struct model *model)
{
    struct surroundings_object *all = list_objects(model);
    if (all && model->surroundings_object_count)
        printf("\nopaque surroundings:\n  %-24s %10s  %s\n", "name", "triangles", "materials");
    for (uint32_t i = 0; all && i < model->surroundings_object_count; i++) {
        const char *name = model->surroundings_names[i];
        printf("  %-24s %10u  ", name[0] ? name : "(no name)", all[i].triangle_count);
        for (uint32_t k = 0; k < all[i].material_count; k++) {
            const char *material = model->materials[all[i].materials[k]].name;
            printf("%s%s", k ? ", " : "",
                   k == MATERIALS_LISTED ? "..."
                   : material[0]         ? material
                                         : "(no name)");
        }
        printf("\n");
    }
    free(all);
}

json_t *info_surroundings_json(const struct model *model)
{
    struct surroundings_object *all = list_objects(model);
    json_t *list = all ? json_array() : NULL;
    for (uint32_t i = 0; list && i < model->surroundings_object_count; i++) {
        json_t *materials = json_array();
        for (uint32_t k = 0; k < all[i].material_count && k < MATERIALS_LISTED && materials; k++)
            materials = json_text_append(materials, json_integer((int)all[i].materials[k]));
        json_t *name = json_string(model->surroundings_names[i]);
        list = json_text_append(
            list, json_pack("{s:o, s:i, s:o}", "name", name ? name : json_string("?"), "triangles",
                            (int)all[i].triangle_count, "materials", materials));
    }
    free(all);
    return list;
}
