/* png_read.c: reads PNG files with libpng's simplified interface. */
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/file/png.h"
#include "src/file/srgb.h"

static enum status out_of_memory(const char *path, const png_image *png)
{
    log_error("%s: out of memory for %u x %u pixels", path, png->width, png->height);
    return STATUS_TRY_AGAIN;
}

static bool is_png(FILE *file)
{
    uint8_t signature[8];
    const bool is_read = fread(signature, sizeof(signature), 1, file) == 1;
    rewind(file);
    return is_read && png_sig_cmp(signature, 0, sizeof(signature)) == 0;
}

bool png_has_whole_chunks(FILE *file, int64_t size)
{
    uint8_t head[8]; /* length, type */
    int64_t at = sizeof(head);
    bool has_ended = false;
    if (!is_png(file))
        return true;
    while (!has_ended && at <= size && file_seek(file, at) &&
           fread(head, sizeof(head), 1, file) == 1) {
        at += 12 + (int64_t)png_get_uint_32(head);
        has_ended = memcmp(head + 4, "IEND", 4) == 0;
    }
    rewind(file);
    return at <= size;
}

static enum status damaged(const char *path, const char *why)
{
    log_error("%s: not a PNG file, damaged or too large: %s", path, why);
    return STATUS_DATA;
}

static uint32_t count_planes(const png_image *png)
{
    return png->format & PNG_FORMAT_FLAG_ALPHA ? 4 : 3;
}

/* Fills the planes with linear colours. Returns false when out of memory. */
static bool fill_image(struct image *image, const png_image *png, const uint8_t *rgba)
{
    static const char names[4][2] = { "R", "G", "B", "A" };
    const uint32_t plane_count = count_planes(png);
    const size_t count = (size_t)png->width * png->height;
    float linear[256];

    for (int i = 0; i < 256; i++)
        linear[i] = srgb_decode((float)i / 255.0f);
    image_init(image, png->width, png->height);
    for (uint32_t p = 0; p < plane_count; p++) {
        float *texels = image_add_plane(image, names[p], false);
        if (!texels) {
            image_finish(image);
            return false;
        }
        for (size_t i = 0; i < count; i++)
            texels[i] = p < 3 ? linear[rgba[4 * i + p]] : (float)rgba[4 * i + p] / 255.0f;
    }
    return true;
}

static enum status read_texels(const char *path, png_image *png, struct image *image)
{
    png_image source = *png; /* the file's format, for has_alpha */
    uint8_t *rgba;
    enum status status = STATUS_OK;

    png->format = PNG_FORMAT_RGBA;
    rgba = malloc((size_t)png->width * png->height * 4);
    if (!rgba)
        return out_of_memory(path, png);
    if (!png_image_finish_read(png, NULL, rgba, 0, NULL))
        status = damaged(path, png->message);
    else if (!fill_image(image, &source, rgba))
        status = out_of_memory(path, png);
    free(rgba);
    return status;
}

/* Reads the header and checks the size. */
static enum status begin_read(const char *path, png_image *png, FILE *file, int64_t size)
{
    if (!png_has_whole_chunks(file, size))
        return damaged(path, "a chunk is longer than the file");
    if (!png_image_begin_read_from_stdio(png, file))
        return damaged(path, png->message);
    if (png->width > IMAGE_MAX_SIDE || png->height > IMAGE_MAX_SIDE ||
        png->height > IMAGE_MAX_TEXELS / png->width)
        return damaged(path, "size out of range");
    png->flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    return STATUS_OK;
}

enum status png_read(const char *path, struct image *image, image_size_fn *begin, void *user)
{
    png_image png = { .version = PNG_IMAGE_VERSION };
    FILE *file;
    int64_t size;
    enum status status = file_io_open(path, &file, &size);
    if (status != STATUS_OK)
        return status;
    status = begin_read(path, &png, file, size);
    if (status == STATUS_OK && begin)
        status = begin(user, png.width, png.height, count_planes(&png));
    if (status == STATUS_OK)
        status = read_texels(path, &png, image);
    if (status == STATUS_DATA && ferror(file))
        status = STATUS_NO_INPUT; /* "read error" is already logged */
    png_image_free(&png);
    fclose(file);
    return status;
}
