/* weighted_mean.c: luminance-weighted mean of a pixel's samples, for PNG files and windows. */
#include "src/render/weighted_mean.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/half_float.h"
#include "src/settings/scene_settings.h"

enum {
    WEIGHT = 4, /* plane after those of frame_beauty */
    PLANE_COUNT,
};

/* Weight of a neighbour in the separable filter: a Gaussian of sigma 0.6 pixels. */
static const float neighbour_weight = 0.166f;

const struct frame_layer weighted_mean_alpha = { .planes = { "A" }, .mean = true };

static enum tonemap_resolve resolve_of(const struct settings *settings)
{
    return (enum tonemap_resolve)settings_get(settings, settings_find("tonemap.resolve"));
}

float weighted_mean_scale(const struct settings *settings)
{
    return resolve_of(settings) == TONEMAP_RESOLVE_LINEAR
               ? 0.0f
               : exp2f((float)settings_get(settings, settings_find("tonemap.exposure")));
}

bool weighted_mean_is_filtered(const struct settings *settings)
{
    return resolve_of(settings) == TONEMAP_RESOLVE_FILTERED;
}

float weighted_mean_weight(const float rgba[static 4], float scale)
{
    const float luminance = 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2];
    const float alpha = fmaxf(rgba[3], 0.0f);
    return 1.0f / (1.0f + scale * fmaxf(luminance, 0.0f) / (alpha > 0.0f ? alpha : 1.0f));
}

double weighted_mean_factor(double alpha, double weight, uint32_t samples)
{
    return (weight > 0.0 ? alpha / weight : 1.0) / samples;
}

static const char *plane_name(uint32_t plane)
{
    return plane == WEIGHT ? "weight" : frame_beauty.planes[plane];
}

/* Returns the planes in the order of weighted_mean_add_planes(). */
static void find_planes(const struct image *sums, float *planes[static PLANE_COUNT])
{
    for (uint32_t p = 0; p < PLANE_COUNT; p++)
        planes[p] = sums->planes[p].texels;
}

bool weighted_mean_add_planes(struct image *sums)
{
    for (uint32_t p = 0; p < PLANE_COUNT; p++) {
        if (!image_add_plane(sums, plane_name(p), false))
            return false;
    }
    return true;
}

/* Decodes a half float. Infinity becomes the largest half float. */
static float decode(uint16_t half)
{
    const float value = half_to_float(half), max = 65504.0f;
    return value > max ? max : value;
}

void weighted_mean_add(struct image *sums, const struct tile *tile, const uint16_t *texels,
                       float scale)
{
    float *planes[PLANE_COUNT];
    find_planes(sums, planes);
    for (uint32_t y = 0; y < tile->height; y++) {
        const size_t row = (size_t)(tile->y + y) * sums->width + tile->x;
        for (size_t i = row; i < row + tile->width; i++, texels += 4) {
            const float rgba[4] = { decode(texels[0]), decode(texels[1]), decode(texels[2]),
                                    decode(texels[3]) };
            const float weight = weighted_mean_weight(rgba, scale);
            for (uint32_t c = 0; c < 3; c++)
                planes[c][i] += weight * rgba[c];
            planes[3][i] += rgba[3];
            planes[WEIGHT][i] += weight * rgba[3];
        }
    }
}

void weighted_mean_pixel(const struct image *sums, size_t i, uint32_t samples, float rgba[static 4])
{
    float *planes[PLANE_COUNT];
    find_planes(sums, planes);
    const double factor =
        weighted_mean_factor((double)planes[3][i], (double)planes[WEIGHT][i], samples);
    for (uint32_t c = 0; c < 3; c++)
        rgba[c] = (float)((double)planes[c][i] * factor);
    rgba[3] = planes[3][i] / (float)samples;
}

void weighted_mean_divide(struct image *sums, uint32_t samples)
{
    float *planes[PLANE_COUNT];
    find_planes(sums, planes);
    for (size_t i = 0; i < (size_t)sums->width * sums->height; i++) {
        float rgba[4];
        weighted_mean_pixel(sums, i, samples, rgba);
        for (uint32_t c = 0; c < 4; c++)
            planes[c][i] = rgba[c];
    }
}

/* ---- reconstruction filter ---- */

/* Weighted radiance, weighted alpha and alpha of a pixel. */
struct pixel {
    float values[5];
};

static void weigh_row(const struct image *mean, uint32_t y, float scale, struct pixel *row)
{
    float *planes[4];
    for (uint32_t c = 0; c < 4; c++)
        planes[c] = image_find(mean, plane_name(c)) + (size_t)y * mean->width;
    for (uint32_t x = 0; x < mean->width; x++) {
        const float rgba[4] = { planes[0][x], planes[1][x], planes[2][x], planes[3][x] };
        const float weight = weighted_mean_weight(rgba, scale);
        for (uint32_t c = 0; c < 4; c++)
            row[x].values[c] = weight * rgba[c];
        row[x].values[4] = rgba[3];
    }
}

/* Adds the filtered pixels of a row to `sums`. `weight` is the filter weight of the row. */
static void add_row(const struct pixel *row, uint32_t width, float weight, struct pixel *sums)
{
    for (uint32_t x = 0; x < width; x++) {
        const struct pixel *left = &row[x ? x - 1 : 0], *right = &row[x + 1 < width ? x + 1 : x];
        for (uint32_t c = 0; c < 5; c++)
            sums[x].values[c] += weight * ((1.0f - 2.0f * neighbour_weight) * row[x].values[c] +
                                           neighbour_weight * (left->values[c] + right->values[c]));
    }
}

static void write_row(struct image *mean, uint32_t y, const struct pixel *sums)
{
    float *planes[4];
    for (uint32_t c = 0; c < 4; c++)
        planes[c] = image_find(mean, plane_name(c)) + (size_t)y * mean->width;
    for (uint32_t x = 0; x < mean->width; x++) {
        const float *v = sums[x].values;
        for (uint32_t c = 0; c < 3; c++)
            planes[c][x] = v[3] > 0.0f ? v[c] * v[4] / v[3] : v[c];
        planes[3][x] = v[4];
    }
}

bool weighted_mean_filter(struct image *mean, float scale)
{
    const uint32_t width = mean->width, height = mean->height;
    struct pixel *rows = calloc(4 * (size_t)width, sizeof(*rows)); /* three rows and their sums */
    if (!rows)
        return false;
    struct pixel *sums = rows + 3 * (size_t)width;
    weigh_row(mean, 0, scale, rows);
    for (uint32_t y = 0; y < height; y++) {
        const uint32_t above = y ? y - 1 : 0, below = y + 1 < height ? y + 1 : y;
        if (below > y)
            weigh_row(mean, below, scale, rows + (size_t)(below % 3) * width);
        memset(sums, 0, width * sizeof(*sums));
        add_row(rows + (size_t)(above % 3) * width, width, neighbour_weight, sums);
        add_row(rows + (size_t)(y % 3) * width, width, 1.0f - 2.0f * neighbour_weight, sums);
        add_row(rows + (size_t)(below % 3) * width, width, neighbour_weight, sums);
        write_row(mean, y, sums);
    }
    free(rows);
    return true;
}
