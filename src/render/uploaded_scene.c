/* uploaded_scene.c: a scene's meshes and pictures on the device. */
#include "src/render/uploaded_scene.h"
#include "src/scene/mips.h"
#include "src/tech/bump.h"
#include "src/tech/env_cube.h"
#include "src/tech/frame.h"

static uint32_t full_chain(uint32_t width, uint32_t height)
{
    uint32_t side = width > height ? width : height;
    uint32_t mips = 1;
    while (side >>= 1)
        mips++;
    return mips;
}

void uploaded_scene_describe(const struct scene *scene, struct frame_request *request)
{
    const struct environment *environment = &scene->environment;
    const struct texture_layers *textures = &scene->model.textures;
    if (environment->texels) {
        request->environment = (VkExtent2D){ environment->width, environment->height };
        request->environment_mips = full_chain(environment->width, environment->height);
    }
    if (scene->cube.texels)
        request->cube = (VkExtent2D){ scene->cube.width, scene->cube.width };
    if (textures->texels) {
        request->texture_size = textures->size;
        request->texture_count = textures->count;
        request->texture_mips = full_chain(textures->size, textures->size);
    }
    if (scene->bump.size) {
        request->bump_size = scene->bump.size;
        request->bump_mips = full_chain(scene->bump.size, scene->bump.size);
    }
    if (scene->air_layers.texels) {
        request->air_size = scene->air_layers.size;
        request->air_count = scene->air_layers.count;
        request->air_mips = full_chain(scene->air_layers.size, scene->air_layers.size);
    }
}

static enum status upload_mesh(struct gpu *gpu, const struct mesh *mesh,
                               struct gpu_buffer *vertices, struct gpu_buffer *indices,
                               const char *name)
{
    enum status status =
        gpu_buffer_create(gpu, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, mesh->vertices,
                          (VkDeviceSize)mesh->vertex_count * sizeof(*mesh->vertices), name);
    if (status == STATUS_OK)
        status = gpu_buffer_create(gpu, indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, mesh->indices,
                                   (VkDeviceSize)mesh->index_count * sizeof(*mesh->indices), name);
    return status;
}

static enum status upload_environment(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                      const struct environment *environment)
{
    static const uint16_t black[4] = { 0 };
    bool real = environment->texels;
    uint32_t width = real ? environment->width : 1;
    uint32_t height = real ? environment->height : 1;
    return gpu_image_create(gpu, &on_gpu->environment,
                            &(struct gpu_image_params){
                                .name = frame_environment.name,
                                .format = frame_environment.format,
                                .width = width,
                                .height = height,
                                .mipmaps = real,
                                .texels = real ? environment->texels : black,
                                .texels_size = (size_t)width * height * sizeof(black),
                            });
}

static enum status upload_cube(struct uploaded_scene *on_gpu, struct gpu *gpu,
                               const struct environment *cube)
{
    if (!cube->texels)
        return STATUS_OK;
    return gpu_image_create(gpu, &on_gpu->cube,
                            &(struct gpu_image_params){
                                .name = env_cube_color.name,
                                .format = env_cube_color.format,
                                .width = cube->width,
                                .height = cube->width,
                                .layers = 6,
                                .cube = true,
                                .texels = cube->texels,
                                .texels_size = (size_t)cube->width * cube->height * 8,
                            });
}

static enum status upload_textures(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                   const struct texture_layers *textures)
{
    static const uint8_t white[4] = { 255, 255, 255, 255 };
    bool real = textures->texels;
    uint32_t size = real ? textures->size : 1;
    uint32_t count = real ? textures->count : 1;
    return gpu_image_create(gpu, &on_gpu->textures,
                            &(struct gpu_image_params){
                                .name = frame_textures.name,
                                .format = frame_textures.format,
                                .width = size,
                                .height = size,
                                .layers = count,
                                .mipmaps = real,
                                .texels = real ? textures->texels : white,
                                .texels_size = (size_t)size * size * count * sizeof(white),
                            });
}

static enum status upload_bump(struct uploaded_scene *on_gpu, struct gpu *gpu,
                               const struct bump_maps *maps)
{
    static const uint16_t even[4] = { 0 };
    const struct mips mips = { .side = maps->size ? maps->size : 1, .layers = 1, .channels = 4 };
    return gpu_image_create(gpu, &on_gpu->bump_map,
                            &(struct gpu_image_params){
                                .name = bump_map.name,
                                .format = bump_map.format,
                                .width = mips.side,
                                .height = mips.side,
                                .levels = true,
                                .texels = maps->size ? maps->texels : even,
                                .texels_size = mips_count(&mips) * sizeof(*even),
                            });
}

static enum status upload_air(struct uploaded_scene *on_gpu, struct gpu *gpu,
                              const struct air_layers *layers)
{
    static const uint8_t clear[2] = { 0 };
    bool real = layers->texels;
    const struct mips mips = { real ? layers->size : 1, real ? layers->count : 1, .channels = 2 };
    return gpu_image_create(gpu, &on_gpu->air_layers,
                            &(struct gpu_image_params){
                                .name = frame_air.name,
                                .format = frame_air.format,
                                .width = mips.side,
                                .height = mips.side,
                                .layers = mips.layers,
                                .levels = true,
                                .texels = real ? layers->texels : clear,
                                .texels_size = mips_count(&mips),
                            });
}

enum status uploaded_scene_init(struct uploaded_scene *on_gpu, struct gpu *gpu,
                                const struct scene *scene)
{
    *on_gpu = (struct uploaded_scene){ 0 };
    enum status status = upload_mesh(gpu, &scene->model.object, &on_gpu->object_vertices,
                                     &on_gpu->object_indices, "scene.object");
    if (status == STATUS_OK)
        status = upload_mesh(gpu, &scene->model.surroundings, &on_gpu->surroundings_vertices,
                             &on_gpu->surroundings_indices, "scene.surroundings");
    if (status == STATUS_OK)
        status = upload_mesh(gpu, &scene->cracks, &on_gpu->cracks_vertices, &on_gpu->cracks_indices,
                             "scene.cracks");
    if (status == STATUS_OK)
        status = upload_environment(on_gpu, gpu, &scene->environment);
    if (status == STATUS_OK)
        status = upload_cube(on_gpu, gpu, &scene->cube);
    if (status == STATUS_OK)
        status = upload_textures(on_gpu, gpu, &scene->model.textures);
    if (status == STATUS_OK)
        status = upload_bump(on_gpu, gpu, &scene->bump);
    if (status == STATUS_OK)
        status =
            upload_mesh(gpu, &scene->air, &on_gpu->air_vertices, &on_gpu->air_indices, "scene.air");
    if (status == STATUS_OK)
        status = upload_air(on_gpu, gpu, &scene->air_layers);
    if (status != STATUS_OK)
        uploaded_scene_finish(on_gpu, gpu);
    return status;
}

void uploaded_scene_finish(struct uploaded_scene *on_gpu, struct gpu *gpu)
{
    gpu_buffer_destroy(gpu, &on_gpu->object_vertices);
    gpu_buffer_destroy(gpu, &on_gpu->object_indices);
    gpu_buffer_destroy(gpu, &on_gpu->surroundings_vertices);
    gpu_buffer_destroy(gpu, &on_gpu->surroundings_indices);
    gpu_buffer_destroy(gpu, &on_gpu->cracks_vertices);
    gpu_buffer_destroy(gpu, &on_gpu->cracks_indices);
    gpu_image_destroy(gpu, &on_gpu->environment);
    gpu_image_destroy(gpu, &on_gpu->cube);
    gpu_image_destroy(gpu, &on_gpu->textures);
    gpu_image_destroy(gpu, &on_gpu->bump_map);
    gpu_buffer_destroy(gpu, &on_gpu->air_vertices);
    gpu_buffer_destroy(gpu, &on_gpu->air_indices);
    gpu_image_destroy(gpu, &on_gpu->air_layers);
    *on_gpu = (struct uploaded_scene){ 0 };
}
