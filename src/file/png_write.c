/*
 * png_write.c: writes PNG files with libpng's simplified interface, which needs no setjmp(). The
 * interface has no text chunks, so this file encodes them (PNG specification, 2nd edition, 5.3).
 */
#include <assert.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/file/png.h"

enum {
    CHUNK_SIZE = 12, /* chunk overhead: length, type, CRC */
    NAME_MAX_LENGTH = 79,
    HEAD_SIZE = 8 + CHUNK_SIZE + 13, /* signature and IHDR */
};

static const uint8_t signature[8] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };

static void write_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

static uint32_t read_u32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* Returns the CRC-32 of ISO 3309, one bit at a time, which is fast enough here. */
static uint32_t crc32_of(const uint8_t *bytes, size_t size)
{
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (0xedb88320 & (0 - (sum & 1)));
    }
    return ~sum;
}

/* Begins a chunk and returns a pointer to its data. */
static uint8_t *begin_chunk(uint8_t *chunk, const char *type, size_t data_size)
{
    write_u32(chunk, (uint32_t)data_size);
    memcpy(chunk + 4, type, 4);
    return chunk + 8;
}

/* Writes a chunk's CRC and returns the end of the chunk. */
static uint8_t *end_chunk(uint8_t *chunk)
{
    const size_t data_size = read_u32(chunk);
    write_u32(chunk + 8 + data_size, crc32_of(chunk + 4, 4 + data_size));
    return chunk + CHUNK_SIZE + data_size;
}

/* Returns the size of the chunk at the start of `bytes`, or 0 if it is truncated or damaged. */
static size_t measure_chunk(const uint8_t *bytes, size_t size)
{
    if (size < CHUNK_SIZE || read_u32(bytes) > size - CHUNK_SIZE)
        return 0;
    const size_t data_size = read_u32(bytes);
    if (read_u32(bytes + 8 + data_size) != crc32_of(bytes + 4, 4 + data_size))
        return 0;
    return CHUNK_SIZE + data_size;
}

static bool is_chunk(const uint8_t *chunk, const char *type)
{
    return memcmp(chunk + 4, type, 4) == 0;
}

static bool is_ascii(const char *text)
{
    while (*text > 0 && *text < 0x7f)
        text++;
    return *text == '\0';
}

/* Writes ASCII text as a tEXt chunk, other text as an iTXt chunk (UTF-8). An iTXt chunk has four
 * more zero bytes: they mean no compression, no language and no translated name. */
static uint8_t *write_text(uint8_t *chunk, const struct image_text *text)
{
    const size_t name_size = strlen(text->name) + 1, value_size = strlen(text->value);
    const size_t gap = is_ascii(text->value) ? 0 : 4;
    uint8_t *data = begin_chunk(chunk, gap ? "iTXt" : "tEXt", name_size + gap + value_size);
    memcpy(data, text->name, name_size);
    memset(data + name_size, 0, gap);
    memcpy(data + name_size + gap, text->value, value_size);
    return end_chunk(chunk);
}

/* Returns all text chunks in one malloc'd buffer, or NULL when out of memory. */
static uint8_t *make_texts(const struct png_image_source *picture, size_t *size)
{
    size_t size_max = 1;
    for (uint32_t i = 0; i < picture->text_count; i++) {
        const struct image_text *text = &picture->texts[i];
        assert(text->name[0] && strlen(text->name) <= NAME_MAX_LENGTH);
        size_max += CHUNK_SIZE + strlen(text->name) + 1 + 4 + strlen(text->value);
    }
    uint8_t *chunks = malloc(size_max), *end = chunks;
    for (uint32_t i = 0; chunks && i < picture->text_count; i++)
        end = write_text(end, &picture->texts[i]);
    *size = chunks ? (size_t)(end - chunks) : 0;
    return chunks;
}

static enum status out_of_memory(const struct png_image_source *picture)
{
    log_error("out of memory for a PNG image of %u x %u pixels", picture->width, picture->height);
    return STATUS_TRY_AGAIN;
}

/* Replaces the gAMA chunk at the start of a 16-bit file by an sRGB chunk. libpng writes gAMA,
 * because it takes 16-bit input as linear. */
static void declare_srgb(uint8_t *bytes, size_t *size)
{
    uint8_t *chunk = bytes + HEAD_SIZE;
    const size_t old_size = CHUNK_SIZE + read_u32(chunk);
    assert(is_chunk(chunk, "gAMA"));
    begin_chunk(chunk, "sRGB", 1)[0] = 0; /* rendering intent: perceptual */
    uint8_t *rest = end_chunk(chunk);
    memmove(rest, chunk + old_size, *size - HEAD_SIZE - old_size);
    *size -= (size_t)(chunk + old_size - rest);
}

/* Returns a 16-bit channel. Colours are premultiplied by alpha, as libpng expects them. */
static uint16_t texel_16(const struct png_image_source *picture, size_t i, size_t c)
{
    const uint32_t value = picture->rgba_16[4 * i + c], alpha = picture->rgba_16[4 * i + 3];
    const bool is_premultiplied = picture->has_alpha && c < 3;
    return (uint16_t)(is_premultiplied ? (value * (uint64_t)alpha + 32767) / 65535 : value);
}

static uint32_t format_of(const struct png_image_source *picture)
{
    if (picture->rgba_16)
        return picture->has_alpha ? PNG_FORMAT_LINEAR_RGB_ALPHA : PNG_FORMAT_LINEAR_RGB;
    return picture->has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
}

/* Returns the texels in libpng's input layout, or NULL when out of memory. */
static void *make_texels(const struct png_image_source *picture)
{
    const size_t texel_count = (size_t)picture->width * picture->height;
    const size_t channel_count = picture->has_alpha ? 4 : 3;
    uint8_t *texels = malloc(texel_count * channel_count * (picture->rgba_16 ? 2 : 1));
    for (size_t i = 0; texels && i < texel_count; i++) {
        for (size_t c = 0; c < channel_count; c++) {
            const size_t at = channel_count * i + c;
            if (picture->rgba_16)
                memcpy(texels + 2 * at, &(uint16_t){ texel_16(picture, i, c) }, 2);
            else
                texels[at] = picture->rgba[4 * i + c];
        }
    }
    return texels;
}

/* Encodes an image without text chunks into `bytes`, which must be large enough. */
static enum status encode_texels(const struct png_image_source *picture, uint8_t *bytes,
                                 size_t *size)
{
    /* libpng takes 8-bit input as sRGB and writes an sRGB chunk. */
    png_image png = {
        .version = PNG_IMAGE_VERSION,
        .width = picture->width,
        .height = picture->height,
        .format = format_of(picture),
        .flags = picture->rgba_16 ? PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB : 0, /* no cHRM chunk */
    };
    png_alloc_size_t bytes_size = *size;
    void *texels = make_texels(picture);
    if (!texels)
        return out_of_memory(picture);
    const bool ok = png_image_write_to_memory(&png, bytes, &bytes_size, 0, texels, 0, NULL);
    if (!ok)
        log_error("the PNG image could not be encoded: %s", png.message);
    free(texels);
    *size = bytes_size;
    if (ok && picture->rgba_16)
        declare_srgb(bytes, size);
    return ok ? STATUS_OK : STATUS_FAILED;
}

enum status png_encode(const struct png_image_source *picture, void **data, size_t *size)
{
    const uint32_t width = picture->width, height = picture->height;
    enum status status = STATUS_OK;
    size_t texts_size;

    *data = NULL;
    *size = 0;
    if (width == 0 || height == 0 || height > IMAGE_MAX_TEXELS / width) {
        log_error("a PNG image cannot have %u x %u pixels", width, height);
        return STATUS_FAILED;
    }
    const png_image png = {
        .width = width,
        .height = height,
        .format = format_of(picture),
    };
    size_t bytes_size = PNG_IMAGE_PNG_SIZE_MAX(png);
    uint8_t *texts = make_texts(picture, &texts_size);
    uint8_t *bytes = texts ? malloc(bytes_size + texts_size) : NULL;
    status = bytes ? encode_texels(picture, bytes, &bytes_size) : out_of_memory(picture);
    if (status == STATUS_OK) {
        memmove(bytes + HEAD_SIZE + texts_size, bytes + HEAD_SIZE, bytes_size - HEAD_SIZE);
        memcpy(bytes + HEAD_SIZE, texts, texts_size);
        *data = bytes;
        *size = bytes_size + texts_size;
        bytes = NULL;
    }
    free(bytes);
    free(texts);
    return status;
}

/* Reads a whole file into *bytes, which the caller frees. */
static enum status read_file(const char *path, uint8_t **bytes, size_t *size)
{
    FILE *file;
    int64_t file_size;
    enum status status = file_io_open(path, &file, &file_size);

    *bytes = NULL;
    if (status != STATUS_OK)
        return status;
    *size = (size_t)file_size;
    *bytes = malloc(*size + 1);
    if (!*bytes) {
        status = log_out_of_memory(path);
    } else if (fread(*bytes, 1, *size, file) != *size) {
        log_error("%s: cannot be read to its end", path);
        status = STATUS_NO_INPUT;
    }
    fclose(file);
    if (status != STATUS_OK) {
        free(*bytes);
        *bytes = NULL;
    }
    return status;
}

/* Adds the text of a tEXt or iTXt chunk; ignores other chunks. Returns false when out of memory. */
static bool add_text(struct image_header *head, const uint8_t *chunk)
{
    const char *data = (const char *)chunk + 8;
    const size_t size = read_u32(chunk), gap = is_chunk(chunk, "iTXt") ? 4 : 0;
    const char *end = memchr(data, '\0', size);
    const size_t name_size = end ? (size_t)(end - data) + 1 : size + 1;
    if ((!gap && !is_chunk(chunk, "tEXt")) || name_size + gap > size)
        return true;
    return image_header_add_text(head, data, data + name_size + gap, size - name_size - gap);
}

/* Reads size and channels from the IHDR chunk. Returns false when out of memory. */
static bool read_size(struct image_header *head, const uint8_t *chunk)
{
    static const char *const names[] = { "R", "G", "B", "A" };

    enum {
        COLOR_TYPE_AT = 9,
        HAS_ALPHA = 4,
    };

    const uint8_t *data = chunk + 8;
    const uint32_t plane_count = data[COLOR_TYPE_AT] & HAS_ALPHA ? 4 : 3;
    bool done = true;
    image_init(&head->image, read_u32(data), read_u32(data + 4));
    for (uint32_t p = 0; p < plane_count && done; p++)
        done = image_header_add_plane(head, names[p], false);
    return done;
}

/* Parses all chunks of a file. Returns false if one is damaged, or when out of memory. */
static bool read_chunks(struct image_header *head, const uint8_t *bytes, size_t size,
                        bool *is_out_of_memory)
{
    bool has_texels = false, has_end = false;
    size_t at = sizeof(signature);
    while (at < size && !has_end) {
        const size_t chunk_size = measure_chunk(bytes + at, size - at);
        const uint8_t *chunk = bytes + at;
        const bool is_first = at == sizeof(signature);
        if (chunk_size == 0 || is_first != (is_chunk(chunk, "IHDR") && read_u32(chunk) == 13))
            return false;
        *is_out_of_memory = !(is_first ? read_size(head, chunk) : add_text(head, chunk));
        if (*is_out_of_memory)
            return false;
        has_texels = has_texels || is_chunk(chunk, "IDAT");
        has_end = is_chunk(chunk, "IEND");
        at += chunk_size;
    }
    return has_texels && has_end && at == size;
}

enum status png_check(const char *path, struct image_header *head)
{
    size_t size = 0;
    uint8_t *bytes;
    bool is_out_of_memory = false;
    enum status status = read_file(path, &bytes, &size);

    *head = (struct image_header){ 0 };
    if (status != STATUS_OK)
        return status;
    if (size < sizeof(signature) || memcmp(bytes, signature, sizeof(signature)) != 0 ||
        !read_chunks(head, bytes, size, &is_out_of_memory)) {
        image_header_finish(head);
        status = is_out_of_memory ? log_out_of_memory(path) : STATUS_DATA;
    }
    if (status == STATUS_DATA)
        log_error("%s: not a PNG file, or damaged", path);
    free(bytes);
    return status;
}

bool png_matches(const struct image_header *head, const struct png_image_source *picture)
{
    struct image_plane planes[] = {
        { .name = "R" },
        { .name = "G" },
        { .name = "B" },
        { .name = "A" },
    };
    const uint32_t plane_count = picture->has_alpha ? 4 : 3;
    const struct image image = { picture->width, picture->height, plane_count, planes };
    return image_header_matches(head, &image, picture->texts, picture->text_count);
}
