/*
 * png.c: writes PNG files by libpng's simplified interface, which needs no setjmp(). It does not
 * support texts; they are written and searched for as chunks (PNG specification, second edition,
 * 5.3).
 */
#include "src/image/png.h"
#include <assert.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/image/file.h"

enum {
    CHUNK_SIZE = 12, /* of a chunk without data: length, type, checksum */
    NAME_MAX_LENGTH = 79,
    HEAD_SIZE = 8 + CHUNK_SIZE + 13, /* signature and IHDR */
};

/* ---- chunks ---- */

static void put_u32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (24 - 8 * i));
}

static uint32_t get_u32(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* CRC-32 of ISO 3309, bit by bit: fast enough for a file that has been rendered. */
static uint32_t check_sum(const uint8_t *bytes, size_t size)
{
    uint32_t sum = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (0xedb88320 & (0 - (sum & 1)));
    }
    return ~sum;
}

/* Begins a chunk and returns where its data begin. */
static uint8_t *begin_chunk(uint8_t *chunk, const char *type, size_t data_size)
{
    put_u32(chunk, (uint32_t)data_size);
    memcpy(chunk + 4, type, 4);
    return chunk + 8;
}

/* Writes the checksum and returns the end of the chunk. */
static uint8_t *end_chunk(uint8_t *chunk)
{
    const size_t data_size = get_u32(chunk);
    put_u32(chunk + 8 + data_size, check_sum(chunk + 4, 4 + data_size));
    return chunk + CHUNK_SIZE + data_size;
}

/* Returns the size of the chunk at the beginning, or 0 if it is incomplete or damaged. */
static size_t measure_chunk(const uint8_t *bytes, size_t size)
{
    if (size < CHUNK_SIZE || get_u32(bytes) > size - CHUNK_SIZE)
        return 0;
    const size_t data_size = get_u32(bytes);
    if (get_u32(bytes + 8 + data_size) != check_sum(bytes + 4, 4 + data_size))
        return 0;
    return CHUNK_SIZE + data_size;
}

static bool is_chunk(const uint8_t *chunk, const char *type)
{
    return memcmp(chunk + 4, type, 4) == 0;
}

/* ---- texts ---- */

static bool is_ascii(const char *text)
{
    while (*text > 0 && *text < 0x7f)
        text++;
    return *text == '\0';
}

/* A tEXt chunk has Latin-1, an iTXt chunk UTF-8 after four bytes: not compressed, no language. */
static uint8_t *put_text(uint8_t *chunk, const struct image_text *text)
{
    const size_t name_size = strlen(text->name) + 1, value_size = strlen(text->value);
    const size_t gap = is_ascii(text->value) ? 0 : 4;
    uint8_t *data = begin_chunk(chunk, gap ? "iTXt" : "tEXt", name_size + gap + value_size);
    memcpy(data, text->name, name_size);
    memset(data + name_size, 0, gap);
    memcpy(data + name_size + gap, text->value, value_size);
    return end_chunk(chunk);
}

/* Returns all text chunks, malloc'd, or NULL when out of memory. */
static uint8_t *make_texts(const struct png_picture *picture, size_t *size)
{
    size_t size_max = 1;
    for (uint32_t i = 0; i < picture->text_count; i++) {
        const struct image_text *text = &picture->texts[i];
        assert(text->name[0] && strlen(text->name) <= NAME_MAX_LENGTH);
        size_max += CHUNK_SIZE + strlen(text->name) + 1 + 4 + strlen(text->value);
    }
    uint8_t *chunks = malloc(size_max), *end = chunks;
    for (uint32_t i = 0; chunks && i < picture->text_count; i++)
        end = put_text(end, &picture->texts[i]);
    *size = chunks ? (size_t)(end - chunks) : 0;
    return chunks;
}

static bool has_chunk(const uint8_t *chunks, size_t size, const uint8_t *wanted, size_t wanted_size)
{
    for (size_t at = 0, chunk_size; at < size; at += chunk_size) {
        chunk_size = CHUNK_SIZE + get_u32(chunks + at);
        if (chunk_size == wanted_size && memcmp(chunks + at, wanted, wanted_size) == 0)
            return true;
    }
    return false;
}

/* ---- files ---- */

static enum status out_of_memory(const struct png_picture *picture)
{
    log_error("out of memory for a PNG picture of %u x %u pixels", picture->width, picture->height);
    return STATUS_TRY_AGAIN;
}

/* Encodes the picture without texts into `bytes`, which has room for it. */
static enum status encode_texels(const struct png_picture *picture, uint8_t *bytes, size_t *size)
{
    const size_t texel_count = (size_t)picture->width * picture->height;
    /* libpng takes 8 bits a channel as sRGB, and writes an sRGB chunk. */
    png_image png = {
        .version = PNG_IMAGE_VERSION,
        .width = picture->width,
        .height = picture->height,
        .format = PNG_FORMAT_RGB,
    };
    png_alloc_size_t bytes_size = *size;
    uint8_t *rgb = malloc(texel_count * 3);

    if (!rgb)
        return out_of_memory(picture);
    for (size_t i = 0; i < texel_count; i++) {
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = picture->rgba[4 * i + c];
    }
    const bool ok = png_image_write_to_memory(&png, bytes, &bytes_size, 0, rgb, 0, NULL);
    if (!ok)
        log_error("a PNG picture could not be encoded: %s", png.message);
    free(rgb);
    *size = bytes_size;
    return ok ? STATUS_OK : STATUS_FAILED;
}

enum status png_encode(const struct png_picture *picture, void **data, size_t *size)
{
    const uint32_t width = picture->width, height = picture->height;
    enum status status = STATUS_OK;
    size_t texts_size;

    *data = NULL;
    *size = 0;
    if (width == 0 || height == 0 || height > IMAGE_MAX_TEXELS / width) {
        log_error("a PNG picture cannot have %u x %u pixels", width, height);
        return STATUS_FAILED;
    }
    const png_image png = { .width = width, .height = height, .format = PNG_FORMAT_RGB };
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

static void *read_file(const char *path, size_t *size)
{
    FILE *file;
    int64_t file_size;
    void *data;

    if (file_open(path, &file, &file_size) != STATUS_OK)
        return NULL;
    *size = (size_t)file_size;
    data = malloc(*size + 1);
    if (data && fread(data, 1, *size, file) != *size) {
        free(data);
        data = NULL;
    }
    fclose(file);
    return data;
}

static void make_head(uint8_t head[static HEAD_SIZE], const struct png_picture *picture)
{
    static const uint8_t signature[8] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    static const uint8_t rgb[5] = { 8, 2, 0, 0, 0 };
    uint8_t *data = begin_chunk(head + sizeof(signature), "IHDR", 13);

    memcpy(head, signature, sizeof(signature));
    put_u32(data, picture->width);
    put_u32(data + 4, picture->height);
    memcpy(data + 8, rgb, sizeof(rgb));
    end_chunk(head + sizeof(signature));
}

bool png_matches(const char *path, const struct png_picture *picture)
{
    uint8_t head[HEAD_SIZE];
    size_t size = 0, texts_size, text_count = 0, at = HEAD_SIZE;
    bool has_texels = false, has_end = false, same;
    uint8_t *texts = make_texts(picture, &texts_size);
    uint8_t *bytes = texts ? read_file(path, &size) : NULL;

    make_head(head, picture);
    same = bytes && size >= HEAD_SIZE && memcmp(bytes, head, HEAD_SIZE) == 0;
    while (same && !has_end) {
        const size_t chunk_size = measure_chunk(bytes + at, size - at);
        same = chunk_size > 0;
        if (!same)
            break;
        text_count += has_chunk(texts, texts_size, bytes + at, chunk_size);
        has_texels = has_texels || is_chunk(bytes + at, "IDAT");
        has_end = is_chunk(bytes + at, "IEND");
        at += chunk_size;
    }
    free(texts);
    free(bytes);
    return same && has_texels && at == size && text_count == picture->text_count;
}

/* Returns the value of a text chunk of this name, malloc'd; NULL if it is another chunk or memory
 * is short. */
static char *copy_text(const uint8_t *chunk, const char *name)
{
    const size_t name_size = strlen(name) + 1;
    const size_t gap = is_chunk(chunk, "iTXt") ? 4 : 0;
    const size_t data_size = get_u32(chunk);

    if ((!gap && !is_chunk(chunk, "tEXt")) || data_size < name_size + gap ||
        memcmp(chunk + 8, name, name_size) != 0)
        return NULL;
    return strndup((const char *)chunk + 8 + name_size + gap, data_size - name_size - gap);
}

enum status png_inspect(const char *path, const char *name, char **text)
{
    size_t size = 0, at = 8, chunk_size = 1;
    uint8_t *bytes = read_file(path, &size);
    bool has_end = false;

    *text = NULL;
    if (!bytes)
        return STATUS_NO_INPUT;
    while (chunk_size > 0 && !has_end && at < size) {
        chunk_size = measure_chunk(bytes + at, size - at);
        if (chunk_size > 0 && !*text)
            *text = copy_text(bytes + at, name);
        has_end = chunk_size > 0 && is_chunk(bytes + at, "IEND");
        at += chunk_size;
    }
    const bool is_whole = has_end && at == size && memcmp(bytes + 1, "PNG", 3) == 0;
    free(bytes);
    if (is_whole && (*text || (*text = strdup(""))))
        return STATUS_OK;
    free(*text);
    *text = NULL;
    if (is_whole)
        return log_out_of_memory(path);
    log_error("%s: not a PNG file, or damaged", path);
    return STATUS_DATA;
}
