/* uploaded_scene.c: uploads the meshes, images and buffers of a scene that techniques use. */
#include "src/render/uploaded_scene.h"
#include <meshoptimizer.h>
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/render/blas_groups.h"
#include "src/scene/mip_levels.h"
#include "src/tech/techniques.h"

/* Maximum simplification errors, as fractions of the mesh size. The surroundings have the smaller
 * error, because gaps would appear where surfaces touch, such as water on stone. */
static const float object_error = 0.003f;
static const float surroundings_error = 0.0003f;

static enum status upload_mesh(struct gpu *gpu, const struct mesh *mesh, struct uploaded_mesh *to,
                               const char *name)
{
    enum status status =
        gpu_buffer_create(gpu, &to->vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, mesh->vertices,
                          (VkDeviceSize)mesh->vertex_count * sizeof(*mesh->vertices), name);
    if (status == STATUS_OK)
        status =
            gpu_buffer_create(gpu, &to->indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, mesh->indices,
                              (VkDeviceSize)mesh->index_count * sizeof(*mesh->indices), name);
    return status;
}

static enum status upload_meshes(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                 const struct scene *scene)
{
    enum status status = upload_mesh(gpu, &scene->model.object, &on_gpu->object, "scene.object");
    if (status == STATUS_OK)
        status = upload_mesh(gpu, &scene->model.surroundings, &on_gpu->surroundings,
                             "scene.surroundings");
    for (size_t i = 0; techniques[i] && status == STATUS_OK; i++) {
        if (techniques[i]->mesh)
            status = upload_mesh(gpu, techniques[i]->mesh(scene), &on_gpu->meshes[i],
                                 techniques[i]->name);
    }
    return status;
}

/* Returns the size in bytes of a scene image's texels, without mip levels generated later. */
static size_t size_of(const struct technique_texels *texels, size_t texel_size)
{
    const uint32_t layers = texels->layers ? texels->layers : 1;
    const struct mip_levels mip_levels = { .side = texels->width, .layers = layers, .channels = 1 };
    if (texels->all_mips)
        return mip_levels_count(&mip_levels) * texel_size;
    return (size_t)texels->width * texels->height * layers * texel_size;
}

enum status uploaded_scene_check(const struct gpu *gpu, const struct scene *scene)
{
    const struct technique_import *import;
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && (import = techniques_import(i)); i++) {
        if (import->buffer)
            continue;
        const struct technique_texels texels = import->find(scene);
        if (texels.texels)
            status = gpu_check_texels(gpu, import->image->name,
                                      (VkExtent3D){ texels.width, texels.height, texels.layers });
    }
    return status;
}

static enum status upload_image(struct uploaded_import *to, struct gpu *gpu,
                                const struct technique_import *import, const struct scene *scene)
{
    const struct rg_image *image = import->image;
    struct technique_texels texels = import->find(scene);
    const bool is_real = texels.texels;
    to->declared = image;
    if (!is_real && !import->fallback)
        return STATUS_OK;
    if (!is_real)
        texels = (struct technique_texels){
            .texels = import->fallback, .width = 1, .height = 1, .all_mips = texels.all_mips
        };
    return gpu_image_create(
        gpu, &to->image,
        &(struct gpu_image_params){
            .name = image->name,
            .format = image->format,
            .width = texels.width,
            .height = texels.height,
            .layers = texels.layers ? texels.layers : image->array,
            .cube = image->cube,
            .mipmaps = is_real && !texels.all_mips && !texels.no_mips,
            .levels = texels.all_mips,
            .texels = texels.texels,
            .texels_size = size_of(&texels, rg_format_info(image->format)->size),
        });
}

static enum status upload_buffer(struct uploaded_import *to, struct gpu *gpu,
                                 const struct technique_import *import, const struct scene *scene)
{
    static const uint32_t zeros[16] = { 0 };
    const struct rg_buffer *buffer = import->buffer;
    struct technique_bytes bytes = import->find_bytes(scene, buffer);
    to->declared_buffer = buffer;
    if (!bytes.bytes)
        bytes = (struct technique_bytes){ zeros, buffer->size };
    const VkPhysicalDeviceLimits *limits = &gpu->properties.limits;
    const bool is_texels = buffer->format;
    const size_t limit =
        is_texels ? (size_t)limits->maxTexelBufferElements * rg_format_info(buffer->format)->size
                  : limits->maxStorageBufferRange;
    if (bytes.size > limit) {
        log_error("%s has %zu bytes: %s reads at most %zu; use a simpler model, or "
                  "another refraction model",
                  buffer->name, bytes.size, gpu->properties.deviceName, limit);
        return STATUS_DATA;
    }
    return gpu_buffer_create(gpu, &to->buffer,
                             is_texels ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT
                                       : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                             bytes.bytes, bytes.size, buffer->name);
}

static enum status upload_imports(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                  const struct scene *scene, bool are_buffers)
{
    const struct technique_import *import;
    enum status status = STATUS_OK;
    for (size_t i = 0; status == STATUS_OK && (import = techniques_import(i)); i++) {
        struct uploaded_import *to = &on_gpu->imports[on_gpu->import_count++];
        if (import->is_structure)
            to->declared_buffer =
                import->buffer; /* created later by uploaded_scene_build_acceleration() */
        else if (import->buffer && are_buffers)
            status = upload_buffer(to, gpu, import, scene);
        else if (import->image && !are_buffers)
            status = upload_image(to, gpu, import, scene);
    }
    return status;
}

static size_t count_imports(void)
{
    size_t count = 0;
    while (techniques_import(count))
        count++;
    return count;
}

enum status uploaded_scene_init(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                const struct scene *scene)
{
    *on_gpu = (struct uploaded_scene){
        .meshes = calloc(techniques_count, sizeof(*on_gpu->meshes)),
        .imports = calloc(count_imports() + 1, sizeof(*on_gpu->imports)),
    };
    enum status status = on_gpu->meshes && on_gpu->imports ? upload_meshes(on_gpu, gpu, scene)
                                                           : log_out_of_memory(NULL);
    if (status == STATUS_OK)
        status = upload_imports(on_gpu, gpu, scene, false);
    if (status != STATUS_OK)
        uploaded_scene_finish(on_gpu, gpu);
    return status;
}

/* Simplifies a mesh. `error` is a fraction of the mesh size. If at least 3/4 of the triangles would
 * remain, the mesh is not simplified. */
static enum status add_coarse(struct gpu *gpu, const struct mesh *mesh, struct uploaded_mesh *to,
                              float error)
{
    const size_t size = (size_t)mesh->index_count * sizeof(*mesh->indices);
    if (!mesh->index_count || to->coarse.buffer)
        return STATUS_OK;
    uint32_t *indices = malloc(size);
    if (!indices)
        return log_out_of_memory(NULL);
    const size_t count =
        meshopt_simplify(indices, mesh->indices, mesh->index_count, mesh->vertices[0].position.raw,
                         mesh->vertex_count, sizeof(mesh->vertices[0]), 0, error, 0, NULL);
    enum status status = STATUS_OK;
    if (count && 4 * count < (size_t)3 * mesh->index_count)
        status = gpu_buffer_create(gpu, &to->coarse, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, indices,
                                   count * sizeof(*indices), "scene.simplified");
    free(indices);
    return status;
}

enum status uploaded_scene_add_simplified(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                          const struct scene *scene)
{
    const struct model *model = &scene->model;
    enum status status = STATUS_OK;
    if (model->object_count <= 1)
        status = add_coarse(gpu, &model->object, &on_gpu->object, object_error);
    if (status == STATUS_OK)
        status = add_coarse(gpu, &model->surroundings, &on_gpu->surroundings, surroundings_error);
    return status;
}

enum status uploaded_scene_init_bvh(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                    const struct scene *scene)
{
    *on_gpu = (struct uploaded_scene){
        .imports = calloc(count_imports() + 1, sizeof(*on_gpu->imports)),
    };
    enum status status =
        on_gpu->imports ? upload_imports(on_gpu, gpu, scene, true) : log_out_of_memory(NULL);
    if (status != STATUS_OK)
        uploaded_scene_finish(on_gpu, gpu);
    return status;
}

enum status uploaded_scene_build_acceleration(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                              const struct scene *scene)
{
    struct gpu_blas_groups groups;
    struct gpu_acceleration *rays = gpu->rays;
    const double start = clock_ms();
    if (on_gpu->rays)
        return STATUS_OK;
    enum status status = blas_groups_init(&groups, scene->bvh, scene->rest != NULL);
    gpu->rays = NULL;
    if (rays && (status != STATUS_OK || !blas_groups_keep(&groups, &rays->built))) {
        gpu_acceleration_destroy(gpu, rays);
        rays = NULL;
    }
    if (status == STATUS_OK && !rays)
        status = gpu_acceleration_create(gpu, &rays, &groups);
    if (status == STATUS_OK)
        status = gpu_acceleration_build(gpu, rays, &groups);
    gpu_blas_groups_finish(&groups);
    if (rays)
        rays->ms = clock_ms() - start;
    on_gpu->rays = rays;
    on_gpu->has_poses = scene->rest != NULL;
    return status;
}

/* Destroys the acceleration structures. If the scene is animated, keeps them in gpu->rays instead.
 */
static void release_rays(struct uploaded_scene *on_gpu, struct gpu *gpu)
{
    struct gpu_acceleration *unused = on_gpu->rays;
    if (on_gpu->rays && on_gpu->has_poses) {
        unused = gpu->rays;
        gpu->rays = on_gpu->rays;
    }
    gpu_acceleration_destroy(gpu, unused);
}

static void destroy_mesh(struct gpu *gpu, struct uploaded_mesh *mesh)
{
    gpu_buffer_destroy(gpu, &mesh->vertices);
    gpu_buffer_destroy(gpu, &mesh->indices);
    gpu_buffer_destroy(gpu, &mesh->coarse);
}

void uploaded_scene_finish(struct uploaded_scene *on_gpu, struct gpu *gpu)
{
    release_rays(on_gpu, gpu);
    destroy_mesh(gpu, &on_gpu->object);
    destroy_mesh(gpu, &on_gpu->surroundings);
    for (size_t i = 0; on_gpu->meshes && i < techniques_count; i++)
        destroy_mesh(gpu, &on_gpu->meshes[i]);
    for (size_t i = 0; i < on_gpu->import_count; i++)
        gpu_image_destroy(gpu, &on_gpu->imports[i].image);
    for (size_t i = 0; i < on_gpu->import_count; i++)
        gpu_buffer_destroy(gpu, &on_gpu->imports[i].buffer);
    free(on_gpu->meshes);
    free(on_gpu->imports);
    *on_gpu = (struct uploaded_scene){ 0 };
}

struct rg_mesh uploaded_scene_mesh(const struct uploaded_mesh *mesh, bool is_coarse)
{
    const struct gpu_buffer *indices =
        is_coarse && mesh->coarse.buffer ? &mesh->coarse : &mesh->indices;
    return (struct rg_mesh){
        .vertices = mesh->vertices.buffer,
        .indices = indices->buffer,
        .index_count = (uint32_t)(indices->size / sizeof(uint32_t)),
    };
}

VkImage uploaded_scene_image(const struct uploaded_scene *on_gpu, const struct rg_image *declared)
{
    for (size_t i = 0; i < on_gpu->import_count; i++) {
        if (on_gpu->imports[i].declared == declared)
            return on_gpu->imports[i].image.image;
    }
    return VK_NULL_HANDLE;
}

VkBuffer uploaded_scene_buffer(const struct uploaded_scene *on_gpu,
                               const struct rg_buffer *declared)
{
    for (size_t i = 0; i < on_gpu->import_count; i++) {
        if (on_gpu->imports[i].declared_buffer == declared)
            return on_gpu->imports[i].buffer.buffer;
    }
    return VK_NULL_HANDLE;
}
