/* mtl_textures.c: loads the textures of MTL materials and computes their coordinate transforms. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/obj_ply.h"

/* Texture of the material for each MTL map; map_d is merged into the base colour texture. */
static const uint32_t uses[MTL_MAP_COUNT] = {
    [MTL_MAP_COLOR] = MATERIAL_BASE_COLOR,
    [MTL_MAP_ALPHA] = MATERIAL_BASE_COLOR,
    [MTL_MAP_SPECULAR] = MATERIAL_SPECULAR_COLOR,
    [MTL_MAP_EMISSION] = MATERIAL_EMISSION,
    [MTL_MAP_BUMP] = MATERIAL_NORMAL,
};

static const enum model_texture_conversion changes[MTL_MAP_COUNT] = {
    [MTL_MAP_ALPHA] = MODEL_TEXTURE_TO_ALPHA,
    [MTL_MAP_BUMP] = MODEL_TEXTURE_TO_NORMALS,
};

/* Images to be loaded as layers of one texture array. */
struct image_list {
    struct model_texture *images;
    uint32_t count;
};

static bool is_same(const char *a, const char *b)
{
    return a && b ? !strcmp(a, b) : a == b;
}

/* Returns the path of a map's file, which the caller frees; NULL after a failure. */
static char *path_of(const struct obj_ply *obj_ply, struct mtl_map *map, enum status *status)
{
    const char *path = obj_ply->import->path;
    if (!model_file_clean(map->file, false)) {
        log_error("%s: texture %s: expected a file within the model's folder", path, map->file);
        *status = STATUS_DATA;
        return NULL;
    }
    char *file = model_file_join(path, map->file);
    if (!file)
        *status = log_out_of_memory(path);
    return file;
}

/* Finds or adds an image, and takes ownership of *image. Returns 1 + the layer; 0 on failure. */
static uint32_t add_image(const struct obj_ply *obj_ply, struct image_list *image_list,
                          const struct model_texture *image)
{
    uint32_t layer = 0;
    while (layer < image_list->count) {
        const struct model_texture *other = &image_list->images[layer];
        if (is_same(other->file, image->file) && is_same(other->alpha, image->alpha) &&
            other->change == image->change)
            break;
        layer++;
    }
    if (layer == image_list->count && layer < MODEL_TEXTURE_MAX) {
        image_list->images[image_list->count++] = *image;
        return layer + 1;
    }
    free(image->file);
    free(image->alpha);
    if (layer < MODEL_TEXTURE_MAX)
        return layer + 1;
    log_error("%s: expected at most %d textures", obj_ply->import->path, MODEL_TEXTURE_MAX);
    return 0;
}

/* Computes the transform of texture coordinates from the base colour map `base` to `map`. The
 * vertices store the coordinates of `base`, with v = 0 at the top. */
static void compute_transform(const struct mtl_map *base, const struct mtl_map *map,
                              struct material_texture *texture)
{
    const float u = map->scale[0] / base->scale[0], v = map->scale[1] / base->scale[1];
    const float moved = map->offset[1] - v * base->offset[1];
    texture->u_row = (vec3s){ { u, 0, map->offset[0] - u * base->offset[0] } };
    texture->v_row = (vec3s){ { 0, v, 1 - v - moved } };
    texture->wrap_u = map->is_clamped ? MATERIAL_CLAMP : MATERIAL_REPEAT;
    texture->wrap_v = texture->wrap_u;
}

const struct mtl_map *mtl_base_map(const struct mtl_material *material)
{
    static const struct mtl_map none = { .scale = { 1, 1 } };
    if (material->maps[MTL_MAP_COLOR].file)
        return &material->maps[MTL_MAP_COLOR];
    return material->maps[MTL_MAP_ALPHA].file ? &material->maps[MTL_MAP_ALPHA] : &none;
}

/* Adds the image of a map to the list and sets the material's texture. */
static enum status add_map(const struct obj_ply *obj_ply, struct image_list *image_list,
                           struct mtl_material *material, enum mtl_map_use use)
{
    struct mtl_map *map = &material->maps[use];
    struct material_texture *texture = &material->material.textures[uses[use]];
    enum status status = STATUS_OK;
    struct model_texture map_image = { .change = changes[use] };
    map_image.file = path_of(obj_ply, map, &status);
    if (map_image.file && use == MTL_MAP_COLOR && material->maps[MTL_MAP_ALPHA].file)
        map_image.alpha = path_of(obj_ply, &material->maps[MTL_MAP_ALPHA], &status);
    map_image.name = map_image.file;
    if (status != STATUS_OK) {
        free(map_image.file);
        return status;
    }
    compute_transform(mtl_base_map(material), map, texture);
    if (uses[use] == MATERIAL_BASE_COLOR) { /* vertices have its coordinates */
        texture->u_row = (vec3s){ { 1, 0, 0 } };
        texture->v_row = (vec3s){ { 0, 1, 0 } };
    }
    texture->layer = add_image(obj_ply, image_list, &map_image);
    return texture->layer > 0 ? STATUS_OK : STATUS_DATA;
}

/* Returns true if a map becomes a separate texture, which is linear if `are_numbers` and sRGB
 * otherwise. map_d becomes a separate texture only if there is no map_Kd. */
static bool is_separate_texture(const struct mtl_material *material, enum mtl_map_use use,
                                bool are_numbers)
{
    if (!material->maps[use].file || material_texture_is_color(uses[use]) == are_numbers)
        return false;
    return (use != MTL_MAP_ALPHA || !material->maps[MTL_MAP_COLOR].file) &&
           material->material.textures[uses[use]].layer == 0;
}

static enum status load_kind(struct obj_ply *obj_ply, bool are_numbers,
                             struct texture_layers *layers)
{
    struct image_list image_list = { .images =
                                         calloc(MODEL_TEXTURE_MAX, sizeof(*image_list.images)) };
    enum status status = image_list.images ? STATUS_OK : log_out_of_memory(obj_ply->import->path);
    for (uint32_t i = 0; i < obj_ply->part_count && status == STATUS_OK; i++) {
        const struct obj_ply_part *part = &obj_ply->parts[i];
        if (part->material == 0 || !part->has_uvs || part->index_count == 0)
            continue;
        struct mtl_material *material = &obj_ply->materials[part->material - 1];
        for (uint32_t use = 0; use < MTL_MAP_COUNT && status == STATUS_OK; use++) {
            if (is_separate_texture(material, use, are_numbers))
                status = add_map(obj_ply, &image_list, material, use);
        }
    }
    if (status == STATUS_OK)
        status = model_texture_load(obj_ply->import, image_list.images, image_list.count,
                                    are_numbers, layers);
    for (uint32_t i = 0; i < image_list.count; i++) {
        free(image_list.images[i].file);
        free(image_list.images[i].alpha);
    }
    free(image_list.images);
    return status;
}

/* Removes maps in unsupported image formats from a material. */
static enum status drop_unsupported(struct obj_ply *obj_ply, struct mtl_material *material)
{
    enum status status = STATUS_OK;
    for (uint32_t use = 0; use < MTL_MAP_COUNT && status == STATUS_OK; use++) {
        struct mtl_map *map = &material->maps[use];
        struct model_texture map_image = { .file =
                                               map->file ? path_of(obj_ply, map, &status) : NULL };
        const char *format = map_image.file ? model_texture_unsupported_format(&map_image) : NULL;
        char words[48];
        free(map_image.file);
        if (!format)
            continue;
        (void)snprintf(words, sizeof(words), "textures in the format %s", format);
        obj_ply_note_undrawn(obj_ply->undrawn_materials, words);
        free(map->file);
        map->file = NULL;
    }
    return status;
}

/* Applies the base colour map's options -s and -o to the texture coordinates of a part. */
static void transform_uvs(const struct obj_ply *obj_ply, const struct obj_ply_part *part)
{
    const struct mtl_map *base = mtl_base_map(&obj_ply->materials[part->material - 1]);
    for (size_t i = 0; i < part->vertex_count; i++) {
        float *uv = &obj_ply->uvs[2 * (part->first_vertex + i)];
        for (int k = 0; k < 2; k++)
            uv[k] = uv[k] * base->scale[k] + base->offset[k];
    }
}

enum status mtl_textures_load(struct obj_ply *obj_ply, struct model *model)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < obj_ply->part_count && status == STATUS_OK; i++) {
        const struct obj_ply_part *part = &obj_ply->parts[i];
        if (part->material == 0 || !part->has_uvs)
            continue;
        status = drop_unsupported(obj_ply, &obj_ply->materials[part->material - 1]);
        if (status == STATUS_OK)
            transform_uvs(obj_ply, part);
    }
    if (status == STATUS_OK)
        status = load_kind(obj_ply, false, &model->textures);
    return status == STATUS_OK ? load_kind(obj_ply, true, &model->numbers) : status;
}
