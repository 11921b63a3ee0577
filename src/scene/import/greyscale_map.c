/* greyscale_map.c: loads an image file as a square greyscale map, with supersampled resampling. */
#include "src/scene/import/greyscale_map.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/image_receive.h"
#include "src/file/srgb.h"

/* Largest finite half float. Sums and differences of values up to it are finite floats. */
#define GREY_MAX 65504.0f

/* Greyscale image at its original size. */
struct greyscale_image {
    float *texels;
    uint32_t width, height;
};

/* Finds the planes R, G and B, or one grey plane for all three. Returns false if there is none. */
static bool find_planes(const struct image *image, const float *planes[static 3])
{
    static const char *const colors[] = { "R", "G", "B" };
    for (int c = 0; c < 3; c++) {
        planes[c] = image_find(image, colors[c]);
        if (!planes[c])
            planes[c] = image_find(image, "Y");
        if (!planes[c] && image->plane_count == 1)
            planes[c] = image->planes[0].texels;
    }
    return planes[0] && planes[1] && planes[2];
}

static enum status convert_to_grey(struct greyscale_image *grey, const struct image *image,
                                   const char *path)
{
    const size_t length = strlen(path), count = (size_t)image->width * image->height;
    const bool is_png = length > 4 && !strcmp(path + length - 4, ".png");
    const float *planes[3];
    bool is_in_range = true;
    if (!find_planes(image, planes)) {
        log_error("%s: expected the channels R, G and B, or a single one", path);
        return STATUS_DATA;
    }
    *grey = (struct greyscale_image){ malloc(count * sizeof(float)), image->width, image->height };
    if (!grey->texels)
        return log_out_of_memory(path);
    for (size_t i = 0; i < count; i++) {
        const float mean = (planes[0][i] + planes[1][i] + planes[2][i]) / 3.0f;
        grey->texels[i] = is_png ? srgb_encode(mean) : mean;
        is_in_range &= fabsf(mean) <= GREY_MAX; /* also false for NaN */
    }
    if (is_in_range)
        return STATUS_OK;
    log_error("%s: expected numbers from -%.0f to %.0f", path, (double)GREY_MAX, (double)GREY_MAX);
    return STATUS_DATA;
}

static float texel_at(const struct greyscale_image *p, int64_t x, int64_t y)
{
    const int64_t width = p->width, height = p->height;
    const int64_t row = (y % height + height) % height;
    return p->texels[row * width + (x % width + width) % width];
}

/* Samples the image bilinearly at (u, v), both from 0 to 1. */
static float sample_bilinear(const struct greyscale_image *p, float u, float v)
{
    const float x = u * (float)p->width - 0.5f, y = v * (float)p->height - 0.5f;
    const int64_t left = (int64_t)floorf(x), top = (int64_t)floorf(y);
    const float right = x - (float)left, down = y - (float)top;
    const float upper = texel_at(p, left, top) * (1 - right) + texel_at(p, left + 1, top) * right;
    const float lower =
        texel_at(p, left, top + 1) * (1 - right) + texel_at(p, left + 1, top + 1) * right;
    return upper * (1 - down) + lower * down;
}

/* Resamples to side x side texels. Takes enough samples per texel to cover all source texels. */
static void resample(const struct greyscale_image *p, float *greys, uint32_t side,
                     bool is_unit_range)
{
    const uint32_t longest = p->width > p->height ? p->width : p->height;
    const uint32_t taps = (longest + side - 1) / side;
    const float step = 1.0f / (float)(side * taps);
    for (uint32_t i = 0; i < side * side; i++) {
        double sum = 0;
        for (uint32_t tap = 0; tap < taps * taps; tap++) {
            const uint32_t x = i % side * taps + tap % taps;
            const uint32_t y = i / side * taps + tap / taps;
            sum += (double)sample_bilinear(p, ((float)x + 0.5f) * step, ((float)y + 0.5f) * step);
        }
        const float mean = (float)(sum / (taps * taps));
        greys[i] = is_unit_range ? fminf(fmaxf(mean, 0), 1) : mean;
    }
}

enum status greyscale_map_read(float **greys, uint32_t side, bool is_unit_range, const char *path,
                               const struct reader_params *params)
{
    static const struct reader_params usual = { 0 };
    struct image image = { 0 };
    struct greyscale_image greyscale = { 0 };
    *greys = NULL;
    if (!image_reader_knows_suffix(path)) {
        log_error("%s: unknown image format; expected .exr, .hdr or .png", path);
        return STATUS_DATA;
    }
    enum status status = image_reader_read(&image, path, params ? params : &usual);
    if (status == STATUS_OK)
        status = convert_to_grey(&greyscale, &image, path);
    image_finish(&image);
    if (status == STATUS_OK) {
        *greys = malloc((size_t)side * side * sizeof(**greys));
        status = *greys ? STATUS_OK : log_out_of_memory(path);
    }
    if (status == STATUS_OK)
        resample(&greyscale, *greys, side, is_unit_range);
    free(greyscale.texels);
    return status;
}
