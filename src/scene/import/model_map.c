/* model_map.c: loads the textures of MTL materials and computes their coordinate transforms. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/import/model_plain.h"

/* Texture of the material for each MTL map; map_d is merged into the base colour texture. */
static const enum material_texture_use uses[PLAIN_MAP_COUNT] = {
    [PLAIN_COLOR] = MATERIAL_BASE_COLOR,
    [PLAIN_ALPHA] = MATERIAL_BASE_COLOR,
    [PLAIN_SPECULAR] = MATERIAL_SPECULAR_COLOR,
    [PLAIN_EMISSION] = MATERIAL_EMISSION,
    [PLAIN_ROUGHNESS] = MATERIAL_METALLIC_ROUGHNESS,
    [PLAIN_SHININESS] = MATERIAL_METALLIC_ROUGHNESS,
    [PLAIN_METALLIC] = MATERIAL_METALLIC_ROUGHNESS,
    [PLAIN_BUMP] = MATERIAL_NORMAL,
};

static const enum model_picture_change changes[PLAIN_MAP_COUNT] = {
    [PLAIN_ALPHA] = MODEL_PICTURE_TO_ALPHA,
    [PLAIN_ROUGHNESS] = MODEL_PICTURE_ROUGHNESS,
    [PLAIN_SHININESS] = MODEL_PICTURE_NS_TO_ROUGHNESS,
    [PLAIN_METALLIC] = MODEL_PICTURE_METALLIC,
    [PLAIN_BUMP] = MODEL_PICTURE_TO_NORMALS,
};

/* Images to be loaded as layers of one texture array. */
struct image_list {
    struct model_picture *pictures;
    uint32_t count;
};

static bool is_same(const char *a, const char *b)
{
    return a && b ? !strcmp(a, b) : a == b;
}

/* Returns the path of a map's file, which the caller frees; NULL after a failure. */
static char *path_of(const struct plain *plain, struct plain_map *map, enum status *status)
{
    const char *path = plain->import->path;
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

/* Finds or adds an image and takes ownership of it. Returns its layer + 1, or 0 on failure. */
static uint32_t add_image(const struct plain *plain, struct image_list *image_list,
                          const struct model_picture *wanted)
{
    uint32_t layer = 0;
    while (layer < image_list->count) {
        const struct model_picture *other = &image_list->pictures[layer];
        if (is_same(other->file, wanted->file) && is_same(other->other, wanted->other) &&
            other->change == wanted->change && !(other->exponent < wanted->exponent) &&
            !(other->exponent > wanted->exponent))
            break;
        layer++;
    }
    if (layer == image_list->count && layer < MODEL_TEXTURE_MAX) {
        image_list->pictures[image_list->count++] = *wanted;
        return layer + 1;
    }
    free(wanted->file);
    free(wanted->other);
    if (layer < MODEL_TEXTURE_MAX)
        return layer + 1;
    log_error("%s: expected at most %d textures", plain->import->path, MODEL_TEXTURE_MAX);
    return 0;
}

/* Computes the transform from the vertices' coordinates, which are those of the base colour map
 * with v = 0 at the top, to those of another map. */
static void compute_transform(const struct plain_map *base, const struct plain_map *map,
                              struct material_texture *texture)
{
    const float u = map->scale[0] / base->scale[0], v = map->scale[1] / base->scale[1];
    const float moved = map->offset[1] - v * base->offset[1];
    texture->u_row = (vec3s){ { u, 0, map->offset[0] - u * base->offset[0] } };
    texture->v_row = (vec3s){ { 0, v, 1 - v - moved } };
    texture->wrap_u = map->is_clamped ? MATERIAL_CLAMP : MATERIAL_REPEAT;
    texture->wrap_v = texture->wrap_u;
}

const struct plain_map *plain_base_map(const struct plain_material *material)
{
    static const struct plain_map none = { .scale = { 1, 1 } };
    if (material->maps[PLAIN_COLOR].file)
        return &material->maps[PLAIN_COLOR];
    return material->maps[PLAIN_ALPHA].file ? &material->maps[PLAIN_ALPHA] : &none;
}

/* Returns the map that fills one channel of map `use`'s texture; PLAIN_MAP_COUNT: no map does. */
static enum plain_map_use merged_map(const struct plain_material *material, enum plain_map_use use)
{
    enum plain_map_use other = PLAIN_MAP_COUNT;
    if (use == PLAIN_COLOR)
        other = PLAIN_ALPHA;
    else if (use == PLAIN_ROUGHNESS || use == PLAIN_SHININESS)
        other = PLAIN_METALLIC;
    return other < PLAIN_MAP_COUNT && material->maps[other].file ? other : PLAIN_MAP_COUNT;
}

/* Sets a material's roughness or metallic factor to 1 if a texture replaces it. */
static void reset_factor(struct material *m, enum plain_map_use use)
{
    if (use == PLAIN_ROUGHNESS || use == PLAIN_SHININESS)
        m->roughness = 1;
    else if (use == PLAIN_METALLIC)
        m->metallic = 1;
}

/* Adds the image of a map to the list and sets the material's texture. */
static enum status add_map(const struct plain *plain, struct image_list *image_list,
                           struct plain_material *material, enum plain_map_use use)
{
    struct plain_map *map = &material->maps[use];
    struct material_texture *texture = &material->material.textures[uses[use]];
    enum status status = STATUS_OK;
    struct model_picture picture = { .change = changes[use] };
    if (use == PLAIN_SHININESS)
        picture.exponent = material->exponent;
    picture.file = path_of(plain, map, &status);
    const enum plain_map_use other = merged_map(material, use);
    if (picture.file && other < PLAIN_MAP_COUNT) {
        picture.other = path_of(plain, &material->maps[other], &status);
        picture.other_change = changes[other];
        reset_factor(&material->material, other);
    }
    reset_factor(&material->material, use);
    picture.name = picture.file;
    if (status != STATUS_OK) {
        free(picture.file);
        return status;
    }
    compute_transform(plain_base_map(material), map, texture);
    if (uses[use] == MATERIAL_BASE_COLOR) { /* vertices have its coordinates */
        texture->u_row = (vec3s){ { 1, 0, 0 } };
        texture->v_row = (vec3s){ { 0, 1, 0 } };
    }
    texture->layer = add_image(plain, image_list, &picture);
    return texture->layer > 0 ? STATUS_OK : STATUS_DATA;
}

/* Returns true if a map becomes a texture of its own of the wanted kind (sRGB colour or linear
 * numbers). map_d does only if there is no map_Kd. */
static bool is_wanted(const struct plain_material *material, enum plain_map_use use,
                      bool are_numbers)
{
    if (!material->maps[use].file || material_texture_is_color(uses[use]) == are_numbers)
        return false;
    return (use != PLAIN_ALPHA || !material->maps[PLAIN_COLOR].file) &&
           material->material.textures[uses[use]].layer == 0;
}

static enum status load_kind(struct plain *plain, bool are_numbers, struct texture_layers *layers)
{
    struct image_list image_list = { .pictures =
                                         calloc(MODEL_TEXTURE_MAX, sizeof(*image_list.pictures)) };
    enum status status = image_list.pictures ? STATUS_OK : log_out_of_memory(plain->import->path);
    for (uint32_t i = 0; i < plain->part_count && status == STATUS_OK; i++) {
        const struct plain_part *part = &plain->parts[i];
        if (part->material == 0 || !part->has_uvs || part->index_count == 0)
            continue;
        struct plain_material *material = &plain->materials[part->material - 1];
        for (uint32_t use = 0; use < PLAIN_MAP_COUNT && status == STATUS_OK; use++) {
            if (is_wanted(material, use, are_numbers))
                status = add_map(plain, &image_list, material, use);
        }
    }
    if (status == STATUS_OK)
        status = model_picture_load(plain->import->path, image_list.pictures, image_list.count,
                                    are_numbers, layers);
    for (uint32_t i = 0; i < image_list.count; i++) {
        free(image_list.pictures[i].file);
        free(image_list.pictures[i].other);
    }
    free(image_list.pictures);
    return status;
}

/* Removes the maps of a material whose image format is not supported. */
static enum status drop_unsupported(struct plain *plain, struct plain_material *material)
{
    enum status status = STATUS_OK;
    for (uint32_t use = 0; use < PLAIN_MAP_COUNT && status == STATUS_OK; use++) {
        struct plain_map *map = &material->maps[use];
        struct model_picture picture = { .file = map->file ? path_of(plain, map, &status) : NULL };
        const char *format = picture.file ? model_picture_unread(&picture) : NULL;
        char words[48];
        free(picture.file);
        if (!format)
            continue;
        (void)snprintf(words, sizeof(words), "textures in the format %s", format);
        plain_note(plain->undrawn_materials, words);
        free(map->file);
        map->file = NULL;
    }
    return status;
}

/* Applies the base colour map's -s and -o to the texture coordinates of a part's vertices. */
static void transform_uvs(const struct plain *plain, const struct plain_part *part)
{
    const struct plain_map *base = plain_base_map(&plain->materials[part->material - 1]);
    for (size_t i = 0; i < part->vertex_count; i++) {
        float *uv = &plain->uvs[2 * (part->first_vertex + i)];
        for (int k = 0; k < 2; k++)
            uv[k] = uv[k] * base->scale[k] + base->offset[k];
    }
}

enum status plain_load_pictures(struct plain *plain, struct model *model)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < plain->part_count && status == STATUS_OK; i++) {
        const struct plain_part *part = &plain->parts[i];
        if (part->material == 0 || !part->has_uvs)
            continue;
        status = drop_unsupported(plain, &plain->materials[part->material - 1]);
        if (status == STATUS_OK)
            transform_uvs(plain, part);
    }
    if (status == STATUS_OK)
        status = load_kind(plain, false, &model->textures);
    return status == STATUS_OK ? load_kind(plain, true, &model->numbers) : status;
}
