/* fuzz_scene.c: checks that accepted models and panoramas are valid for every pass. */
#include "tests/fuzz/fuzz_scene.h"
#include <math.h>
#include <string.h>
#include "tests/fuzz/fuzz.h"

enum {
    HALF_MAX = 0x7bff /* bits of the largest finite half; negative ones have more */
};

static void check_mesh(const struct mesh *mesh, const struct texture_layers *textures)
{
    FUZZ_CHECK(mesh->index_count % 3 == 0);
    for (uint32_t i = 0; i < mesh->index_count; i++)
        FUZZ_CHECK(mesh->indices[i] < mesh->vertex_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const struct mesh_vertex *vertex = &mesh->vertices[i];
        for (int k = 0; k < 3; k++)
            FUZZ_CHECK(isfinite(vertex->position.raw[k]) && isfinite(vertex->normal.raw[k]) &&
                       vertex->color.raw[k] >= 0 &&
                       vertex->color.raw[k] <= (vertex->material & MESH_UNLIT ? 65504 : 1));
        FUZZ_CHECK((vertex->material & MESH_TEXTURE_MASK) <= textures->count);
    }
}

static void check_cameras(const struct model *model)
{
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const struct model_camera *camera = &model->cameras[i];
        FUZZ_CHECK(memchr(camera->name, 0, sizeof(camera->name)));
        FUZZ_CHECK(camera->camera.fov_deg > 0 && camera->camera.fov_deg < 180);
        FUZZ_CHECK((camera->kind == MODEL_ORTHOGRAPHIC) == (camera->height > 0));
    }
}

void fuzz_check_model(const struct model *model)
{
    FUZZ_CHECK(model->object.index_count + model->surroundings.index_count > 0);
    check_mesh(&model->object, &model->textures);
    check_mesh(&model->surroundings, &model->textures);
    check_cameras(model);
    for (uint32_t i = 0; i < model->light_count; i++)
        FUZZ_CHECK(punctual_light_is_valid(&model->lights[i]));
    for (uint32_t i = 0; i < model->extension_count; i++)
        FUZZ_CHECK(memchr(model->extensions[i].name, 0, MATERIAL_NAME_SIZE) &&
                   model->extensions[i].support < MODEL_SUPPORT_COUNT);
    FUZZ_CHECK(model->animation <= model->animation_count);
    for (uint32_t i = 0; i < model->animation_count; i++)
        FUZZ_CHECK(memchr(model->animations[i].name, 0, MATERIAL_NAME_SIZE) &&
                   model->animations[i].seconds >= 0);
    for (uint32_t i = 0; i < model->surroundings_object_count; i++)
        FUZZ_CHECK(model->surroundings_starts[i] < model->surroundings.vertex_count &&
                   (i == 0 || model->surroundings_starts[i] > model->surroundings_starts[i - 1]));
    uint32_t end = 0;
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        FUZZ_CHECK(object->first_index == end && object->material < model->material_count);
        end += object->index_count;
    }
    FUZZ_CHECK(end == model->object.index_count);
    for (uint32_t i = 0; i < model->material_count; i++) {
        struct material material = model->materials[i];
        FUZZ_CHECK(!material_clamp(&material));
    }
}

void fuzz_check_no_model(const struct model *model)
{
    FUZZ_CHECK(!model->object.vertices && !model->object.indices && !model->textures.texels &&
               !model->numbers.texels && !model->surroundings.vertices &&
               !model->surroundings.indices && !model->objects && !model->materials &&
               !model->cameras && !model->animations && !model->lights && !model->extensions &&
               !model->surroundings_starts && !model->surroundings_names);
}

void fuzz_check_environment(const struct environment *environment)
{
    FUZZ_CHECK(environment->width > 0 && environment->height > 0);
    for (size_t i = 0; i < (size_t)environment->width * environment->height * 4; i++)
        FUZZ_CHECK(environment->texels[i] <= HALF_MAX);
}

void fuzz_check_no_environment(const struct environment *environment)
{
    FUZZ_CHECK(!environment->texels && environment->width == 0 && environment->height == 0);
}

enum status fuzz_load_environment(const char *path)
{
    struct environment environment;
    const enum status status = environment_load(&environment, path);
    if (status == STATUS_OK)
        fuzz_check_environment(&environment);
    else
        fuzz_check_no_environment(&environment);
    environment_finish(&environment);
    return status;
}
