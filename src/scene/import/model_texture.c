/* model_texture.c: loads the base colour textures of a model file at one size. */
#include <assert.h>
#include <stb/stb_image.h>
#include <stb/stb_image_resize.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include "src/base/log.h"
#include "src/scene/import/model_import.h"

enum {
    PICTURE_SIDE_MAX = 16384,
    FILE_SIZE_MAX = 256 << 20, /* bytes */
    CHANNELS = 4,
};

/* The source of a texture: an embedded texture or a file; the other one is NULL. */
struct source {
    const struct aiTexture *embedded;
    char *file;
    const struct aiMaterial *material; /* the first material that names it */
};

/* An encoded image or, if is_raw, an array of aiTexel. */
struct picture {
    const uint8_t *bytes;
    uint8_t *owned; /* `bytes`, if it must be freed, or NULL */
    int size;       /* bytes */
    int width, height;
    bool is_raw;
};

static enum status fault(const struct model_import *import, const struct source *source,
                         const char *what)
{
    struct aiString name = { 0 };
    uint32_t uv_index;
    if (!source->file)
        model_material_texture(source->material, &name, &uv_index);
    log_error("%s: texture %s: %s", import->path, source->file ? source->file : name.data, what);
    return STATUS_DATA;
}

static enum status read_file(const struct model_import *import, const struct source *source,
                             struct picture *picture)
{
    struct stat info;
    /* Only regular files are opened: opening a pipe would wait for its other end. */
    if (stat(source->file, &info) != 0 || !S_ISREG(info.st_mode))
        return fault(import, source, "file not found");
    if (info.st_size <= 0 || info.st_size > FILE_SIZE_MAX)
        return fault(import, source, "expected a file of 1 byte to 256 MiB");
    size_t size = (size_t)info.st_size;
    FILE *file = fopen(source->file, "rb");
    if (!file)
        return fault(import, source, "the file cannot be opened");
    picture->owned = malloc(size);
    bool is_read = picture->owned && fread(picture->owned, 1, size, file) == size;
    fclose(file);
    if (!picture->owned)
        return log_out_of_memory(import->path);
    if (!is_read)
        return fault(import, source, "the file cannot be read");
    picture->bytes = picture->owned;
    picture->size = (int)size;
    return STATUS_OK;
}

/* Opens an encoded image. The caller frees picture->owned, even on failure. */
static enum status open_picture(const struct model_import *import, const struct source *source,
                                struct picture *picture)
{
    const struct aiTexture *embedded = source->embedded;
    assert(source->file || embedded);
    *picture = (struct picture){ 0 };
    if (source->file) {
        enum status status = read_file(import, source, picture);
        if (status != STATUS_OK)
            return status;
    } else if (embedded->mHeight > 0) {
        picture->is_raw = true;
        picture->bytes = (const uint8_t *)embedded->pcData;
        if (embedded->mWidth <= PICTURE_SIDE_MAX && embedded->mHeight <= PICTURE_SIDE_MAX) {
            picture->width = (int)embedded->mWidth;
            picture->height = (int)embedded->mHeight;
        }
    } else if (embedded->mWidth <= FILE_SIZE_MAX) {
        picture->bytes = (const uint8_t *)embedded->pcData;
        picture->size = (int)embedded->mWidth;
    }

    int channels;
    if (!picture->is_raw && !stbi_info_from_memory(picture->bytes, picture->size, &picture->width,
                                                   &picture->height, &channels))
        return fault(import, source, "not a supported picture format");
    if (picture->width < 1 || picture->width > PICTURE_SIDE_MAX || picture->height < 1 ||
        picture->height > PICTURE_SIDE_MAX)
        return fault(import, source, "expected 1 to 16384 texels per side");
    return STATUS_OK;
}

static uint8_t *decode_raw(const struct picture *picture)
{
    size_t count = (size_t)picture->width * (size_t)picture->height;
    uint8_t *texels = malloc(count * CHANNELS);
    for (size_t i = 0; texels && i < count; i++) {
        const uint8_t *bgra = &picture->bytes[i * CHANNELS];
        uint8_t *rgba = &texels[i * CHANNELS];
        rgba[0] = bgra[2];
        rgba[1] = bgra[1];
        rgba[2] = bgra[0];
        rgba[3] = bgra[3];
    }
    return texels;
}

/* Returns the filter along one axis. The default of stb would blur if the size is unchanged. */
static stbir_filter filter(int from, int to)
{
    return from > to ? STBIR_FILTER_MITCHELL : STBIR_FILTER_CATMULLROM;
}

/* Resamples an image to a layer. Returns false when out of memory. */
static bool resample(uint8_t *layer, uint32_t side, const uint8_t *texels, int width, int height)
{
    int to = (int)side;
    if (width == to && height == to) {
        memcpy(layer, texels, (size_t)side * side * CHANNELS);
        return true;
    }
    return stbir_resize(texels, width, height, 0, layer, to, to, 0, STBIR_TYPE_UINT8, CHANNELS,
                        CHANNELS - 1, 0, STBIR_EDGE_CLAMP, STBIR_EDGE_CLAMP, filter(width, to),
                        filter(height, to), STBIR_COLORSPACE_SRGB, NULL) != 0;
}

static enum status decode(const struct model_import *import, const struct source *source,
                          uint8_t *layer, uint32_t side)
{
    uint8_t *texels = NULL;
    struct picture picture;
    enum status status = open_picture(import, source, &picture);
    if (status != STATUS_OK)
        goto fail;
    if (picture.is_raw) {
        texels = decode_raw(&picture);
    } else {
        texels = stbi_load_from_memory(picture.bytes, picture.size, &picture.width, &picture.height,
                                       &(int){ 0 }, CHANNELS);
        if (!texels)
            status = fault(import, source, stbi_failure_reason());
    }
    if (status == STATUS_OK &&
        (!texels || !resample(layer, side, texels, picture.width, picture.height)))
        status = log_out_of_memory(import->path);
fail:
    free(texels);
    free(picture.owned);
    return status;
}

static uint32_t layer_side(uint32_t side_max, uint32_t count)
{
    uint32_t side = 1;
    while (side < side_max && side < MODEL_TEXTURE_SIDE_MAX)
        side *= 2;
    while (side > 1 && (uint64_t)side * side * CHANNELS * count > MODEL_TEXTURES_SIZE_MAX)
        side /= 2;
    return side;
}

static uint8_t *layer_at(const struct texture_layers *layers, uint32_t index)
{
    return layers->texels + (size_t)index * layers->size * layers->size * CHANNELS;
}

static bool allocate(struct texture_layers *layers, uint32_t side_max, uint32_t count)
{
    uint32_t side = layer_side(side_max, count);
    uint8_t *texels = calloc(count, (size_t)side * side * CHANNELS);
    *layers = (struct texture_layers){ 0 };
    if (texels)
        *layers = (struct texture_layers){ .texels = texels, .size = side, .count = count };
    return texels;
}

static enum status load(const struct model_import *import, const struct source *sources,
                        uint32_t count, struct texture_layers *layers)
{
    int side_max = 1;
    for (uint32_t i = 0; i < count; i++) {
        struct picture picture;
        enum status status = open_picture(import, &sources[i], &picture);
        free(picture.owned);
        if (status != STATUS_OK)
            return status;
        side_max = picture.width > side_max ? picture.width : side_max;
        side_max = picture.height > side_max ? picture.height : side_max;
    }
    if (!allocate(layers, (uint32_t)side_max, count))
        return log_out_of_memory(import->path);
    for (uint32_t i = 0; i < count; i++) {
        enum status status = decode(import, &sources[i], layer_at(layers, i), layers->size);
        if (status != STATUS_OK)
            return status;
    }
    return STATUS_OK;
}

static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *name)
{
    char *end;
    if (name[0] == '*') {
        unsigned long index = strtoul(name + 1, &end, 10);
        return *end == '\0' && index < scene->mNumTextures ? scene->mTextures[index] : NULL;
    }
    for (uint32_t i = 0; i < scene->mNumTextures; i++) {
        if (strcmp(scene->mTextures[i]->mFilename.data, name) == 0)
            return scene->mTextures[i];
    }
    return NULL;
}

static char *join_path(const char *model, const char *name)
{
    const char *slash = strrchr(model, '/');
    size_t folder = slash ? (size_t)(slash - model) + 1 : 0;
    size_t length = strlen(name);
    char *path = malloc(folder + length + 1);
    if (path) {
        memcpy(path, model, folder);
        memcpy(path + folder, name, length + 1);
    }
    return path;
}

static enum status find_source(const struct model_import *import, const struct aiMaterial *material,
                               struct source *source)
{
    struct aiString name = { 0 };
    uint32_t uv_index;
    model_material_texture(material, &name, &uv_index);
    *source = (struct source){
        .embedded = find_embedded(import->scene, name.data),
        .material = material,
    };
    if (source->embedded)
        return STATUS_OK;
    if (!model_file_clean(name.data, import->is_gltf)) {
        log_error("%s: texture %s: expected a file within the model's folder", import->path,
                  name.data);
        return STATUS_DATA;
    }
    source->file = join_path(import->path, name.data);
    return source->file ? STATUS_OK : log_out_of_memory(import->path);
}

static bool is_same(const struct source *a, const struct source *b)
{
    if (a->file && b->file)
        return strcmp(a->file, b->file) == 0;
    return a->embedded && a->embedded == b->embedded;
}

/* Appends the material's source to the list unless it is there, and sets the material's layer. */
static enum status add_source(const struct model_import *import, uint32_t material_index,
                              struct source *sources, uint32_t *count)
{
    struct source source;
    enum status status = find_source(import, import->scene->mMaterials[material_index], &source);
    if (status != STATUS_OK)
        return status;
    uint32_t layer = 0;
    while (layer < *count && !is_same(&source, &sources[layer]))
        layer++;
    if (layer == MODEL_TEXTURE_MAX) {
        log_error("%s: expected at most %d textures", import->path, MODEL_TEXTURE_MAX);
        free(source.file);
        return STATUS_DATA;
    }
    if (layer < *count)
        free(source.file);
    else
        sources[(*count)++] = source;
    import->materials[material_index].layer = layer + 1;
    return STATUS_OK;
}

enum status model_texture_load(struct model_import *import, struct texture_layers *layers)
{
    uint32_t count = 0;
    struct source *sources = calloc(MODEL_TEXTURE_MAX, sizeof(*sources));
    if (!sources)
        return log_out_of_memory(import->path);
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < import->scene->mNumMeshes && status == STATUS_OK; i++) {
        const struct aiMesh *mesh = import->scene->mMeshes[i];
        const struct model_material *material = &import->materials[mesh->mMaterialIndex];
        if (material->is_textured && material->layer == 0 &&
            mesh->mTextureCoords[material->uv_index])
            status = add_source(import, mesh->mMaterialIndex, sources, &count);
    }
    if (status == STATUS_OK && count > 0)
        status = load(import, sources, count, layers);
    for (uint32_t i = 0; i < count; i++)
        free(sources[i].file);
    free(sources);
    return status;
}

static bool copy(struct texture_layers *to, uint32_t first, const struct texture_layers *from)
{
    for (uint32_t i = 0; i < from->count; i++) {
        if (!resample(layer_at(to, first + i), to->size, layer_at(from, i), (int)from->size,
                      (int)from->size))
            return false;
    }
    return true;
}

enum status model_texture_merge(struct texture_layers *both, const struct texture_layers *first,
                                const struct texture_layers *second)
{
    *both = (struct texture_layers){ 0 };
    uint32_t count = first->count + second->count;
    if (count == 0)
        return STATUS_OK;
    if (count > MODEL_TEXTURE_MAX) {
        log_error("expected at most %d textures in all models together", MODEL_TEXTURE_MAX);
        return STATUS_DATA;
    }
    uint32_t side_max = first->size > second->size ? first->size : second->size;
    if (!allocate(both, side_max, count) || !copy(both, 0, first) ||
        !copy(both, first->count, second)) {
        free(both->texels);
        *both = (struct texture_layers){ 0 };
        return log_out_of_memory("textures");
    }
    return STATUS_OK;
}
