/* greyscale_map.c: loads an image file as a square greyscale map, resampled. */
#include "src/scene/import/greyscale_map.h"
#include <math.h>
#include <stb/stb_image_resize.h>
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

/* Resamples to side x side texels: area averages of a larger image, bilinear samples of a smaller
 * one. Returns false when out of memory. */
static bool resample(const struct greyscale_image *p, float *greys, uint32_t side,
                     bool is_unit_range)
{
    if (!stbir_resize(p->texels, (int)p->width, (int)p->height, 0, greys, (int)side, (int)side, 0,
                      STBIR_TYPE_FLOAT, 1, STBIR_ALPHA_CHANNEL_NONE, 0, STBIR_EDGE_WRAP,
                      STBIR_EDGE_WRAP, p->width > side ? STBIR_FILTER_BOX : STBIR_FILTER_TRIANGLE,
                      p->height > side ? STBIR_FILTER_BOX : STBIR_FILTER_TRIANGLE,
                      STBIR_COLORSPACE_LINEAR, NULL))
        return false;
    for (uint32_t i = 0; is_unit_range && i < side * side; i++)
        greys[i] = fminf(fmaxf(greys[i], 0), 1);
    return true;
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
    if (status == STATUS_OK && !resample(&greyscale, *greys, side, is_unit_range)) {
        free(*greys);
        *greys = NULL;
        status = log_out_of_memory(path);
    }
    free(greyscale.texels);
    return status;
}
