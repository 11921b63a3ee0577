/* model_texture.c: decodes and resamples a model's images to an array of square textures. */
#include <assert.h>
#include <cglm/struct.h>
#include <math.h>
#include <stb/stb_image.h>
#include <stb/stb_image_resize.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <webp/decode.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/scene/import/importer.h"
#include "src/scene/import/model_avif.h"

enum {
    IMAGE_SIDE_MAX = 16384,
    FILE_SIZE_MAX = 256 << 20, /* maximum file size, bytes */
    CHANNELS = 4,
    RELIEF = 64,          /* white of a height map is width / RELIEF high */
    BLUE_OF_NORMALS = 16, /* mean |blue-red| of a normal map */
};

/* An encoded image file in memory, and its dimensions. */
struct encoded {
    const uint8_t *bytes;
    uint8_t *owned; /* `bytes` if owned, else NULL */
    int size;       /* bytes */
    int width, height;
    bool is_avif;
};

void model_loss_add(struct model_loss *loss, const char *format, ...)
{
    char text[sizeof(loss->first)];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof(text), format, arguments);
    va_end(arguments);
    if (loss->count == 0)
        memcpy(loss->first, text, sizeof(text));
    loss->count += loss->count == 0 || strcmp(loss->first, text) != 0;
}

static void warn_of_loss(const char *path, const struct model_loss *loss, const char *name,
                         struct model *model)
{
    char more[32] = "";
    const size_t length = strlen(model->undrawn_text);
    if (loss->count == 0)
        return;
    if (loss->count > 1)
        (void)snprintf(more, sizeof(more), " (and %u more)", loss->count - 1);
    log_warning("%s: drawn without %s: %s%s", path, name, loss->first, more);
    (void)snprintf(&model->undrawn_text[length], sizeof(model->undrawn_text) - length, "%s: %s%s\n",
                   name, loss->first, more);
}

void model_loss_warn(const struct model_import *import, struct model *model)
{
    warn_of_loss(import->path, &import->textures, "a texture", model);
    warn_of_loss(import->path, &import->channels, "an animation channel", model);
}

static enum status refuse(const char **fault, const char *what)
{
    *fault = what;
    return STATUS_DATA;
}

static enum status read_file(const struct model_texture *texture, struct encoded *encoded,
                             const char **fault)
{
    const struct file_info info = file_info_of(texture->file);
    /* Opens only regular files, because opening a named pipe would block. */
    if (info.kind != FILE_REGULAR)
        return refuse(fault, model_file_fault(texture->file));
    if (info.size <= 0 || info.size > FILE_SIZE_MAX)
        return refuse(fault, "expected a file of 1 byte to 256 MiB");
    size_t size = (size_t)info.size;
    FILE *file = fopen(texture->file, "rb");
    if (!file)
        return refuse(fault, model_file_fault(texture->file));
    encoded->owned = malloc(size);
    bool is_read = encoded->owned && fread(encoded->owned, 1, size, file) == size;
    fclose(file);
    if (!encoded->owned)
        return STATUS_TRY_AGAIN;
    if (!is_read)
        return refuse(fault, "the file cannot be read");
    encoded->bytes = encoded->owned;
    encoded->size = (int)size;
    return STATUS_OK;
}

const char *model_texture_unsupported_format(const struct model_texture *texture)
{
    static const struct {
        const char *name;
        uint32_t at, size;
        const char *magic;
    } formats[] = {
        { "KTX2", 0, 7, "\xabKTX 20" }, { "DDS", 0, 4, "DDS " },   { "AVIF", 4, 8, "ftypavif" },
        { "OpenEXR", 0, 4, "v/1\x01" }, { "TIFF", 0, 4, "II*\0" }, { "TIFF", 0, 4, "MM\0*" },
    };

    uint8_t head[12] = { 0 };
    if (texture->bytes && texture->size >= sizeof(head))
        memcpy(head, texture->bytes, sizeof(head));
    if (texture->file && file_info_of(texture->file).kind == FILE_REGULAR) {
        FILE *file = fopen(texture->file, "rb");
        if (file && fread(head, 1, sizeof(head), file) != sizeof(head))
            memset(head, 0, sizeof(head));
        if (file)
            fclose(file);
    }
    if (model_avif_is_built() && !memcmp(&head[4], "ftypavif", 8))
        return NULL;
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
        if (!memcmp(&head[formats[i].at], formats[i].magic, formats[i].size))
            return formats[i].name;
    }
    return NULL;
}

static bool is_webp(const struct encoded *encoded)
{
    return encoded->size >= 12 && !memcmp(encoded->bytes, "RIFF", 4) &&
           !memcmp(&encoded->bytes[8], "WEBP", 4);
}

/* Reads the size of an image from its header. Returns false if the format is not supported. */
static bool read_size(struct encoded *encoded)
{
    int channels;
    if (model_avif_read_size(encoded->bytes, (size_t)encoded->size, &encoded->width,
                             &encoded->height)) {
        encoded->is_avif = true;
        return true;
    }
    if (is_webp(encoded))
        return WebPGetInfo(encoded->bytes, (size_t)encoded->size, &encoded->width,
                           &encoded->height) != 0;
    return stbi_info_from_memory(encoded->bytes, encoded->size, &encoded->width, &encoded->height,
                                 &channels) != 0;
}

/* Loads an encoded image and reads its size. The caller frees encoded->owned, even on failure. With
 * STATUS_DATA, *fault is the reason. Logs nothing. */
static enum status open_image(const struct model_texture *texture, struct encoded *encoded,
                              const char **fault)
{
    *encoded = (struct encoded){ 0 };
    if (!texture->bytes) {
        enum status status = read_file(texture, encoded, fault);
        if (status != STATUS_OK)
            return status;
    } else if (texture->size <= FILE_SIZE_MAX) {
        encoded->bytes = texture->bytes;
        encoded->size = (int)texture->size;
    }
    if (!read_size(encoded))
        return refuse(fault, "not a supported image format");
    if (encoded->width < 1 || encoded->width > IMAGE_SIDE_MAX || encoded->height < 1 ||
        encoded->height > IMAGE_SIDE_MAX)
        return refuse(fault, "expected 1 to 16384 texels per side");
    return STATUS_OK;
}

/* Returns the resampling filter of an axis; stb's default would blur an axis of unchanged size. */
static stbir_filter filter(int from, int to)
{
    return from > to ? STBIR_FILTER_MITCHELL : STBIR_FILTER_CATMULLROM;
}

/* Resamples an image to a texture layer. Returns false when out of memory. */
static bool resample(uint8_t *layer, uint32_t side, const uint8_t *texels, int width, int height,
                     bool are_numbers)
{
    /* Weights colours by alpha, so that hidden colours do not bleed. */
    const int alpha = are_numbers ? STBIR_ALPHA_CHANNEL_NONE : CHANNELS - 1;
    int to = (int)side;
    if (width == to && height == to) {
        memcpy(layer, texels, (size_t)side * side * CHANNELS);
        return true;
    }
    return stbir_resize(texels, width, height, 0, layer, to, to, 0, STBIR_TYPE_UINT8, CHANNELS,
                        alpha, 0, STBIR_EDGE_CLAMP, STBIR_EDGE_CLAMP, filter(width, to),
                        filter(height, to),
                        are_numbers ? STBIR_COLORSPACE_LINEAR : STBIR_COLORSPACE_SRGB, NULL) != 0;
}

/* ---- conversion of MTL maps ---- */

static uint8_t grey_of(const uint8_t *texel)
{
    return (uint8_t)((texel[0] + texel[1] + texel[2] + 1) / 3);
}

static void convert_alpha(uint8_t *texels, size_t count)
{
    bool has_alpha = false;
    for (size_t i = 0; i < count; i++)
        has_alpha |= texels[CHANNELS * i + 3] < UINT8_MAX;
    for (size_t i = 0; i < count; i++) {
        uint8_t *texel = &texels[CHANNELS * i];
        texel[3] = has_alpha ? texel[3] : grey_of(texel);
        memset(texel, UINT8_MAX, 3);
    }
}

static bool are_normals(const uint8_t *texels, size_t count)
{
    uint64_t difference = 0;
    for (size_t i = 0; i < count; i++)
        difference += (uint64_t)abs(texels[CHANNELS * i + 2] - texels[CHANNELS * i]);
    return difference > BLUE_OF_NORMALS * (uint64_t)count;
}

/* Converts a tileable height map to a normal map by central differences. If the image is already a
 * normal map, leaves it unchanged. If out of memory, returns false. */
static bool convert_heights(uint8_t *texels, int width, int height)
{
    const size_t count = (size_t)width * (size_t)height;
    if (are_normals(texels, count))
        return true;
    uint8_t *heights = malloc(count);
    if (!heights)
        return false;
    for (size_t i = 0; i < count; i++)
        heights[i] = grey_of(&texels[CHANNELS * i]);
    for (int y = 0; y < height; y++) {
        const uint8_t *above = &heights[(size_t)((y + height - 1) % height) * (size_t)width];
        const uint8_t *below = &heights[(size_t)((y + 1) % height) * (size_t)width];
        const uint8_t *row = &heights[(size_t)y * (size_t)width];
        for (int x = 0; x < width; x++) {
            const float step = 2.0F * UINT8_MAX * RELIEF;
            const float difference = (float)(row[(x + 1) % width] - row[(x + width - 1) % width]);
            const vec3s normal = glms_vec3_normalize((vec3s){ {
                -difference * (float)width / step,
                (float)(below[x] - above[x]) * (float)height / step,
                1,
            } });
            uint8_t *texel = &texels[CHANNELS * ((size_t)y * (size_t)width + (size_t)x)];
            for (int k = 0; k < 3; k++)
                texel[k] = (uint8_t)lroundf(127.5F + 127.5F * normal.raw[k]);
        }
    }
    free(heights);
    return true;
}

/* Converts texels as texture->change specifies. Returns false when out of memory. */
static bool convert(uint8_t *texels, int width, int height, const struct model_texture *texture)
{
    if (texture->change == MODEL_TEXTURE_TO_NORMALS)
        return convert_heights(texels, width, height);
    if (texture->change == MODEL_TEXTURE_TO_ALPHA)
        convert_alpha(texels, (size_t)width * (size_t)height);
    return true;
}

/* ---- decoding ---- */

/* Decodes an image to RGBA texels, which the caller frees. */
static enum status decode_texels(const struct encoded *encoded, uint8_t **texels,
                                 const char **fault)
{
    int width, height, channels;
    if (!is_webp(encoded) && !encoded->is_avif) {
        *texels = stbi_load_from_memory(encoded->bytes, encoded->size, &width, &height, &channels,
                                        CHANNELS);
        if (*texels)
            return STATUS_OK;
        if (strcmp(stbi_failure_reason(), "outofmem") == 0)
            return STATUS_TRY_AGAIN;
        return refuse(fault, "the image is damaged");
    }
    const size_t size = (size_t)encoded->width * (size_t)encoded->height * CHANNELS;
    *texels = malloc(size);
    if (!*texels)
        return STATUS_TRY_AGAIN;
    if (encoded->is_avif) {
        const enum status status = model_avif_decode(encoded->bytes, (size_t)encoded->size,
                                                     encoded->width, encoded->height, *texels);
        return status == STATUS_DATA ? refuse(fault, "the image is damaged") : status;
    }
    if (WebPDecodeRGBAInto(encoded->bytes, (size_t)encoded->size, *texels, size,
                           encoded->width * CHANNELS))
        return STATUS_OK;
    return refuse(fault, "the image is damaged or an animation");
}

/* Fills a layer with the texel that has no effect: white, or the unperturbed normal. */
static void fill_neutral(uint8_t *layer, uint32_t side, bool is_normal_map)
{
    static const uint8_t normal[CHANNELS] = { 128, 128, 255, 255 };
    const size_t size = (size_t)side * side * CHANNELS;
    memset(layer, 255, size);
    for (size_t i = 0; is_normal_map && i < size; i += CHANNELS)
        memcpy(&layer[i], normal, CHANNELS);
}

static enum status decode(struct model_import *import, const struct model_texture *texture,
                          bool are_numbers, uint8_t *layer, uint32_t side)
{
    uint8_t *texels = NULL;
    const char *fault = NULL;
    struct encoded encoded;
    enum status status = open_image(texture, &encoded, &fault);
    if (status == STATUS_OK)
        status = decode_texels(&encoded, &texels, &fault);
    if (status == STATUS_OK &&
        (!convert(texels, encoded.width, encoded.height, texture) ||
         !resample(layer, side, texels, encoded.width, encoded.height, are_numbers)))
        status = STATUS_TRY_AGAIN;
    free(texels);
    free(encoded.owned);
    if (status == STATUS_TRY_AGAIN)
        return log_out_of_memory(import->path);
    if (status == STATUS_DATA) {
        model_loss_add(&import->textures, "%s: %s", texture->name, fault);
        fill_neutral(layer, side,
                     texture->is_normal_map || texture->change == MODEL_TEXTURE_TO_NORMALS);
    }
    return STATUS_OK;
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

/* Decodes a layer. If texture->alpha is set, alpha is taken from that image. */
static enum status decode_both(struct model_import *import, const struct model_texture *texture,
                               bool are_numbers, uint8_t *layer, uint32_t side)
{
    const size_t count = (size_t)side * side;
    enum status status = decode(import, texture, are_numbers, layer, side);
    if (status != STATUS_OK || !texture->alpha)
        return status;
    const struct model_texture alpha = {
        .name = texture->alpha,
        .file = texture->alpha,
        .change = MODEL_TEXTURE_TO_ALPHA,
    };
    assert(count > 0);
    uint8_t *texels = malloc(count * CHANNELS);
    if (!texels)
        return log_out_of_memory(import->path);
    status = decode(import, &alpha, true, texels, side);
    for (size_t i = CHANNELS - 1; i < count * CHANNELS && status == STATUS_OK; i += CHANNELS)
        layer[i] = texels[i];
    free(texels);
    return status;
}

enum status model_texture_load(struct model_import *import, const struct model_texture *textures,
                               uint32_t count, bool are_numbers, struct texture_layers *layers)
{
    const char *path = import->path;
    const char *fault;
    int side_max = 1;
    if (count == 0)
        return STATUS_OK;
    for (uint32_t i = 0; i < count; i++) {
        struct encoded encoded;
        enum status status = open_image(&textures[i], &encoded, &fault);
        free(encoded.owned);
        if (status == STATUS_TRY_AGAIN)
            return log_out_of_memory(path);
        if (status != STATUS_OK)
            continue; /* becomes a neutral layer */
        side_max = encoded.width > side_max ? encoded.width : side_max;
        side_max = encoded.height > side_max ? encoded.height : side_max;
    }
    if (!allocate(layers, (uint32_t)side_max, count))
        return log_out_of_memory(path);
    if (layers->size < (uint32_t)side_max && !import->has_large_texture)
        log_warning("%s: the largest of %u textures has %d texels a side and is downsampled to %u",
                    path, count, side_max, layers->size);
    import->has_large_texture = import->has_large_texture || layers->size < (uint32_t)side_max;
    for (uint32_t i = 0; i < count; i++) {
        enum status status =
            decode_both(import, &textures[i], are_numbers, layer_at(layers, i), layers->size);
        if (status != STATUS_OK)
            return status;
    }
    return STATUS_OK;
}

static bool copy(struct texture_layers *to, uint32_t first, const struct texture_layers *from,
                 bool are_numbers)
{
    for (uint32_t i = 0; i < from->count; i++) {
        if (!resample(layer_at(to, first + i), to->size, layer_at(from, i), (int)from->size,
                      (int)from->size, are_numbers))
            return false;
    }
    return true;
}

enum status model_texture_merge(struct texture_layers *both, const struct texture_layers *first,
                                const struct texture_layers *second, bool are_numbers)
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
    if (!allocate(both, side_max, count) || !copy(both, 0, first, are_numbers) ||
        !copy(both, first->count, second, are_numbers)) {
        free(both->texels);
        *both = (struct texture_layers){ 0 };
        return log_out_of_memory("textures");
    }
    return STATUS_OK;
}
