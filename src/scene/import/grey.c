/* grey.c: the greys of a picture, as a square. */
#include "src/scene/import/grey.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/image/srgb.h"
#include "src/reader/picture_reader.h"

/* The largest number of a half float: sums and slopes of such greys stay finite. */
#define GREY_MAX 65504.0f

/* A picture's greys, of its own size. */
struct grey_picture {
    float *texels;
    uint32_t width, height;
};

/* Returns the planes of the colours, or three times the only one; false: there are none. */
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

static enum status mix(struct grey_picture *grey, const struct image *image, const char *path)
{
    const size_t length = strlen(path), count = (size_t)image->width * image->height;
    const bool is_png = length > 4 && !strcmp(path + length - 4, ".png");
    const float *planes[3];
    bool is_in_range = true;
    if (!find_planes(image, planes)) {
        log_error("%s: expected the channels R, G and B, or a single one", path);
        return STATUS_DATA;
    }
    *grey = (struct grey_picture){ malloc(count * sizeof(float)), image->width, image->height };
    if (!grey->texels)
        return log_out_of_memory(path);
    for (size_t i = 0; i < count; i++) {
        const float mean = (planes[0][i] + planes[1][i] + planes[2][i]) / 3.0f;
        grey->texels[i] = is_png ? srgb_encode(mean) : mean;
        is_in_range &= fabsf(mean) <= GREY_MAX; /* NaN is not */
    }
    if (is_in_range)
        return STATUS_OK;
    log_error("%s: expected numbers from -%.0f to %.0f", path, (double)GREY_MAX, (double)GREY_MAX);
    return STATUS_DATA;
}

/* Returns the texel, or the one that continues the picture beyond its edge. */
static float at(const struct grey_picture *p, int64_t x, int64_t y)
{
    const int64_t width = p->width, height = p->height;
    const int64_t row = (y % height + height) % height;
    return p->texels[row * width + (x % width + width) % width];
}

/* Returns the value at a place from 0 to 1, linear between four texels. */
static float between(const struct grey_picture *p, float u, float v)
{
    const float x = u * (float)p->width - 0.5f, y = v * (float)p->height - 0.5f;
    const int64_t left = (int64_t)floorf(x), top = (int64_t)floorf(y);
    const float right = x - (float)left, low = y - (float)top;
    const float upper = at(p, left, top) * (1 - right) + at(p, left + 1, top) * right;
    const float lower = at(p, left, top + 1) * (1 - right) + at(p, left + 1, top + 1) * right;
    return upper * (1 - low) + lower * low;
}

/* Means of as many places as a texel of the square has texels of the picture across. */
static void resample(const struct grey_picture *p, float *greys, uint32_t side, bool is_share)
{
    const uint32_t longest = p->width > p->height ? p->width : p->height;
    const uint32_t taps = (longest + side - 1) / side;
    const float step = 1.0f / (float)(side * taps);
    for (uint32_t i = 0; i < side * side; i++) {
        double sum = 0;
        for (uint32_t tap = 0; tap < taps * taps; tap++) {
            const uint32_t x = i % side * taps + tap % taps;
            const uint32_t y = i / side * taps + tap / taps;
            sum += (double)between(p, ((float)x + 0.5f) * step, ((float)y + 0.5f) * step);
        }
        const float mean = (float)(sum / (taps * taps));
        greys[i] = is_share ? fminf(fmaxf(mean, 0), 1) : mean;
    }
}

enum status grey_read(float **greys, uint32_t side, bool is_share, const char *path,
                      const struct reader_params *params)
{
    static const struct reader_params usual = { 0 };
    struct image image = { 0 };
    struct grey_picture picture = { 0 };
    *greys = NULL;
    if (!picture_is_named(path)) {
        log_error("%s: unknown picture format; expected .exr, .hdr or .png", path);
        return STATUS_DATA;
    }
    enum status status = picture_read(&image, path, params ? params : &usual);
    if (status == STATUS_OK)
        status = mix(&picture, &image, path);
    image_finish(&image);
    if (status == STATUS_OK) {
        *greys = malloc((size_t)side * side * sizeof(**greys));
        status = *greys ? STATUS_OK : log_out_of_memory(path);
    }
    if (status == STATUS_OK)
        resample(&picture, *greys, side, is_share);
    free(picture.texels);
    return status;
}
