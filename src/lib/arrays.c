/* arrays.c: adds meshes, materials, instances, lights and environments to scenes from arrays. */
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/half_float.h"
#include "src/lib/scene_source.h"

static struct lib_arrays *arrays_of(firn_scene *scene)
{
    if (!scene->arrays)
        scene->arrays = calloc(1, sizeof(*scene->arrays));
    if (!scene->arrays)
        (void)log_out_of_memory(NULL);
    return scene->arrays;
}

/* Begins a call that adds to the arrays of a scene. Sets *arrays to NULL when out of memory. */
static bool enter(struct lib_call *call, firn_scene *scene, struct lib_arrays **arrays)
{
    if (!lib_enter(call, scene ? scene->device : NULL, true))
        return false;
    *arrays = arrays_of(scene);
    return true;
}

static firn_status refused(const firn_scene *scene)
{
    return scene ? FIRN_FAILED : FIRN_USAGE;
}

/* Grows an array by one zeroed element. Returns the new element, or NULL when out of memory. */
static void *append(void **all, uint32_t *count, size_t size)
{
    char *grown = realloc(*all, (*count + (size_t)1) * size);
    if (!grown) {
        (void)log_out_of_memory(NULL);
        return NULL;
    }
    *all = grown;
    memset(grown + *count * size, 0, size);
    return grown + (*count)++ * size;
}

#define APPEND(arrays, member, count) \
    append((void **)&(arrays)->member, &(arrays)->count, sizeof(*(arrays)->member))

/* ---- meshes ---- */

/* Returns a packed copy of `count` rows of `width` floats, or NULL when out of memory. */
static float *pack(const float *rows, size_t stride, uint32_t count, uint32_t width)
{
    const size_t size = width * sizeof(float);
    float *packed = calloc(count ? count : 1, size);
    for (size_t i = 0; i < count && packed; i++)
        memcpy(&packed[i * width], (const char *)rows + i * (stride ? stride : size), size);
    return packed;
}

static enum status copy_mesh(struct model_arrays_mesh *to, const struct firn_mesh *from)
{
    *to = (struct model_arrays_mesh){
        .vertex_count = from->vertex_count,
        .index_count = from->index_count,
        .positions = pack(from->positions, from->position_stride, from->vertex_count, 3),
        .indices = malloc(from->index_count * sizeof(uint32_t)),
    };
    if (from->normals)
        to->normals = pack(from->normals, from->normal_stride, from->vertex_count, 3);
    if (from->uvs)
        to->uvs = pack(from->uvs, from->uv_stride, from->vertex_count, 2);
    if (!to->positions || !to->indices || (from->normals && !to->normals) ||
        (from->uvs && !to->uvs)) {
        model_arrays_mesh_finish(to);
        return log_out_of_memory("mesh");
    }
    memcpy(to->indices, from->indices, from->index_count * sizeof(uint32_t));
    return STATUS_OK;
}

static enum status read_mesh(struct firn_mesh *mesh, const struct firn_mesh *given)
{
    enum status status = lib_read(mesh, sizeof(*mesh), given, "mesh");
    if (status == STATUS_OK)
        status = lib_require(mesh->positions, "mesh.positions");
    if (status == STATUS_OK)
        status = lib_require(mesh->indices, "mesh.indices");
    if (status == STATUS_OK &&
        (!mesh->vertex_count || !mesh->index_count || mesh->index_count % 3 ||
         mesh->index_count > 1u << 28 || mesh->vertex_count > 1u << 28)) {
        log_error("mesh: expected vertices and a multiple of 3 indices, at most 2^28 each, got %u "
                  "vertices and %u indices",
                  mesh->vertex_count, mesh->index_count);
        status = STATUS_USAGE;
    }
    return status;
}

static enum status add_mesh(struct lib_arrays *arrays, const struct firn_mesh *given,
                            uint32_t *number)
{
    struct firn_mesh mesh;
    struct model_arrays_mesh copy = { 0 };
    enum status status = read_mesh(&mesh, given);
    if (status == STATUS_OK)
        status = copy_mesh(&copy, &mesh);
    if (status == STATUS_OK)
        status = model_arrays_check(&copy, "arrays");
    struct model_arrays_mesh *added =
        status == STATUS_OK ? APPEND(&arrays->model, meshes, mesh_count) : NULL;
    if (added) {
        *added = copy;
        if (number)
            *number = arrays->model.mesh_count - 1;
        return STATUS_OK;
    }
    model_arrays_mesh_finish(&copy);
    return status == STATUS_OK ? STATUS_TRY_AGAIN : status;
}

firn_status firn_scene_add_mesh(firn_scene *scene, const struct firn_mesh *mesh, uint32_t *number)
{
    struct lib_call call;
    struct lib_arrays *arrays;
    if (!enter(&call, scene, &arrays))
        return refused(scene);
    return lib_leave(&call, arrays ? add_mesh(arrays, mesh, number) : STATUS_TRY_AGAIN);
}

/* ---- materials, instances, lights ---- */

firn_status firn_scene_add_material(firn_scene *scene, const struct firn_material *material,
                                    uint32_t *number)
{
    struct lib_call call;
    struct lib_arrays *arrays;
    struct material made = material_make("");
    if (!enter(&call, scene, &arrays))
        return refused(scene);
    enum status status = arrays ? lib_material_read(&made, material) : STATUS_TRY_AGAIN;
    struct material *added =
        status == STATUS_OK ? APPEND(&arrays->model, materials, material_count) : NULL;
    if (added) {
        *added = made;
        if (number)
            *number = arrays->model.material_count - 1;
        lib_scene_reload(scene);
    }
    return lib_leave(&call, status == STATUS_OK && !added ? STATUS_TRY_AGAIN : status);
}

static bool is_finite(const float *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(numbers[i]))
            return false;
    }
    return true;
}

static struct affine transform_of(const float world[static 12])
{
    struct affine affine = affine_identity();
    bool is_given = false;
    for (int i = 0; i < 12; i++)
        is_given = is_given || world[i] < 0.0f || world[i] > 0.0f;
    for (int i = 0; i < 12 && is_given; i++)
        affine.rows[i / 4][i % 4] = (double)world[i];
    return affine;
}

static enum status add_instance(struct model_arrays *model, const struct firn_instance *given)
{
    struct firn_instance instance;
    const enum status status = lib_read(&instance, sizeof(instance), given, "instance");
    if (status != STATUS_OK)
        return status;
    const bool has_material = instance.material != FIRN_NO_MATERIAL;
    if (instance.mesh >= model->mesh_count ||
        (has_material && instance.material >= model->material_count) ||
        !is_finite(instance.world, 12)) {
        log_error("instance: expected the number of a mesh below %u, of a material below %u or "
                  "FIRN_NO_MATERIAL, and a finite transform; got mesh %u and material %u",
                  model->mesh_count, model->material_count, instance.mesh, instance.material);
        return STATUS_USAGE;
    }
    struct model_arrays_instance *added = APPEND(model, instances, instance_count);
    if (!added)
        return STATUS_TRY_AGAIN;
    strncpy(added->name, instance.name ? instance.name : "", sizeof(added->name) - 1);
    added->mesh = instance.mesh;
    added->material = has_material ? (int32_t)instance.material : MODEL_ARRAYS_NO_MATERIAL;
    added->world_from_mesh = transform_of(instance.world);
    return STATUS_OK;
}

firn_status firn_scene_add_instance(firn_scene *scene, const struct firn_instance *instance)
{
    struct lib_call call;
    struct lib_arrays *arrays;
    if (!enter(&call, scene, &arrays))
        return refused(scene);
    const enum status status = arrays ? add_instance(&arrays->model, instance) : STATUS_TRY_AGAIN;
    if (status == STATUS_OK)
        lib_scene_reload(scene);
    return lib_leave(&call, status);
}

static enum status add_light(struct model_arrays *model, const struct firn_light *given)
{
    struct firn_light light;
    enum status status = lib_read(&light, sizeof(light), given, "light");
    if (status != STATUS_OK)
        return status;
    vec3s direction = { { light.direction[0], light.direction[1], light.direction[2] } };
    const float length = glms_vec3_norm(direction);
    const struct light made = {
        .kind = light.kind,
        .position = { { light.position[0], light.position[1], light.position[2] } },
        .direction = length > 0.0f ? glms_vec3_divs(direction, length) : (vec3s){ { 0, -1, 0 } },
        .color = { { light.color[0], light.color[1], light.color[2] } },
        .intensity = light.intensity,
        .range = light.range,
        .inner_cone = light.inner_cone,
        .outer_cone = light.outer_cone,
    };
    if (light.kind >= LIGHT_KIND_COUNT || !punctual_light_is_valid(&made)) {
        log_error("light: expected a kind below %d, coordinates within 1e6 metres, colours and "
                  "intensity at least 0, and cones with 0 <= inner < outer <= pi / 2",
                  LIGHT_KIND_COUNT);
        return STATUS_USAGE;
    }
    struct light *added = APPEND(model, lights, light_count);
    if (!added)
        return STATUS_TRY_AGAIN;
    *added = made;
    return STATUS_OK;
}

firn_status firn_scene_add_light(firn_scene *scene, const struct firn_light *light)
{
    struct lib_call call;
    struct lib_arrays *arrays;
    if (!enter(&call, scene, &arrays))
        return refused(scene);
    const enum status status = arrays ? add_light(&arrays->model, light) : STATUS_TRY_AGAIN;
    if (status == STATUS_OK)
        lib_scene_reload(scene);
    return lib_leave(&call, status);
}

/* ---- environment ---- */

static uint16_t half_of(float value)
{
    return value > 0.0f && !isinf(value) ? half_from_float(value) : 0;
}

static enum status set_environment(firn_scene *scene, const struct firn_environment *given)
{
    struct setup_scene *options = &scene->given.scene;
    struct environment *environment = &scene->arrays->environment;
    struct firn_environment e;
    enum status status = lib_read(&e, sizeof(e), given, "environment");
    if (status == STATUS_OK)
        status = lib_require(e.texels, "environment.texels");
    if (status != STATUS_OK)
        return status;
    if (!e.height || e.height > 16384 || e.width != 2 * e.height || !is_finite(&e.rotate_deg, 2) ||
        fabsf(e.exposure) > 16.0f || fabsf(e.rotate_deg) > 360.0f) {
        log_error("environment: expected a width of twice the height, at most 32768, exposure from "
                  "-16 to 16 and rotation from -360 to 360, got %ux%u",
                  e.width, e.height);
        return STATUS_USAGE;
    }
    uint16_t *texels = malloc((size_t)e.width * e.height * 4 * sizeof(*texels));
    if (!texels)
        return log_out_of_memory("environment");
    const size_t row = e.row_stride ? e.row_stride : (size_t)e.width * 3 * sizeof(float);
    for (size_t i = 0; i < (size_t)e.width * e.height; i++) {
        const float *from =
            (const float *)((const char *)e.texels + i / e.width * row) + i % e.width * 3;
        for (size_t c = 0; c < 3; c++)
            texels[4 * i + c] = half_of(from[c]);
        texels[4 * i + 3] = half_from_float(1.0f);
    }
    environment_finish(environment);
    *environment = (struct environment){ .texels = texels, .width = e.width, .height = e.height };
    options->environment = lib_environment_name;
    options->env_rotate = e.rotate_deg;
    options->env_exposure = e.exposure;
    lib_scene_reload(scene);
    return STATUS_OK;
}

firn_status firn_scene_set_environment(firn_scene *scene,
                                       const struct firn_environment *environment)
{
    struct lib_call call;
    struct lib_arrays *arrays;
    if (!enter(&call, scene, &arrays))
        return refused(scene);
    return lib_leave(&call, arrays ? set_environment(scene, environment) : STATUS_TRY_AGAIN);
}
