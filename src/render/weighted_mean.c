/* weighted_mean.c: luminance-weighted mean of a pixel's samples, for PNG files and windows. */
#include "src/render/weighted_mean.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/half_float.h"
#include "src/settings/scene_settings.h"

enum {
    WEIGHT = 4, /* planes after those of frame_beauty */
    VARIANCE,
    PLANE_COUNT,
};

/* Standard error of brightness at which denoising starts. It is complete at twice this error. */
static const float noise = 0.02f;

/* Weight of a neighbour in the separable filter: a Gaussian of sigma 0.6 pixels. */
static const float neighbour_weight = 0.166f;

const struct frame_layer weighted_mean_extra = { .planes = { "weight", "variance" }, .mean = true };

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

static float luminance_of(const float rgb[static 3])
{
    return fmaxf(0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2], 0.0f);
}

float weighted_mean_weight(const float rgba[static 4], float scale)
{
    const float alpha = fmaxf(rgba[3], 0.0f);
    return 1.0f / (1.0f + scale * luminance_of(rgba) / (alpha > 0.0f ? alpha : 1.0f));
}

double weighted_mean_factor(double alpha, double weight, uint32_t samples)
{
    return (weight > 0.0 ? alpha / weight : 1.0) / samples;
}

static const char *plane_name(uint32_t plane)
{
    return plane >= WEIGHT ? weighted_mean_extra.planes[plane - WEIGHT]
                           : frame_beauty.planes[plane];
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
            planes[VARIANCE][i] += sqrtf(scale * weight * luminance_of(rgba));
        }
    }
}

/* Returns the variance of the mean brightness. `luminance` and `brightness` are sums; the sum of
 * squared brightness is the sum of displayed luminance. */
static double variance_of(float luminance, float brightness, uint32_t samples)
{
    const double n = samples, sum = (double)brightness;
    return samples > 1 ? fmax(((double)luminance - sum * sum / n) / (n * (n - 1.0)), 0.0) : 0.0;
}

void weighted_mean_pixel(const struct image *sums, size_t i, uint32_t samples, float scale,
                         struct image *mean)
{
    float *from[PLANE_COUNT], *to[PLANE_COUNT];
    find_planes(sums, from);
    find_planes(mean, to);
    const float rgb[3] = { from[0][i], from[1][i], from[2][i] };
    const double factor =
        weighted_mean_factor((double)from[3][i], (double)from[WEIGHT][i], samples);
    for (uint32_t c = 0; c < 3; c++)
        to[c][i] = (float)((double)rgb[c] * factor);
    to[3][i] = from[3][i] / (float)samples;
    to[VARIANCE][i] = (float)variance_of(scale * luminance_of(rgb), from[VARIANCE][i], samples);
}

void weighted_mean_divide(struct image *sums, uint32_t samples, float scale)
{
    for (size_t i = 0; i < (size_t)sums->width * sums->height; i++)
        weighted_mean_pixel(sums, i, samples, scale, sums);
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

/* ---- denoising ---- */

/* A pixel's brightness, and the variance of that, smoothed over 3 x 3 pixels because its own
 * estimate is noisy. */
struct noisy {
    float brightness, variance;
};

/* The pixels around a pixel, without those outside the image. */
struct around {
    uint32_t left, right, top, bottom;
};

static struct around around(const struct image *image, uint32_t x, uint32_t y)
{
    return (struct around){ x ? x - 1 : 0, x + 1 < image->width ? x + 1 : x, y ? y - 1 : 0,
                            y + 1 < image->height ? y + 1 : y };
}

/* Finds the noise of a row of pixels. */
static void find_noise(const struct image *mean, uint32_t y, const struct pixel *pixels,
                       float scale, struct noisy *noisy)
{
    const float *variance = image_find(mean, plane_name(VARIANCE));
    for (uint32_t x = 0; x < mean->width; x++) {
        const struct around a = around(mean, x, y);
        float sum = 0.0f;
        for (uint32_t v = a.top; v <= a.bottom; v++) {
            for (uint32_t u = a.left; u <= a.right; u++)
                sum += variance[(size_t)v * mean->width + u];
        }
        noisy[x].variance = sum / (float)((a.right - a.left + 1) * (a.bottom - a.top + 1));
        noisy[x].brightness = sqrtf(scale * luminance_of(pixels[x].values));
    }
}

/* Returns the weight of pixel `b` in the average of its neighbour `a`. */
static float similarity(const struct noisy *a, const struct noisy *b)
{
    const float difference = a->brightness - b->brightness;
    const float excess = difference * difference - a->variance - fminf(a->variance, b->variance);
    return expf(-fmaxf(excess, 0.0f) / (4.0f * (a->variance + b->variance) + 1e-6f));
}

/* Pixels and their noise of the denoised row and its neighbours; row y is at y % 3. */
struct rows {
    struct pixel *pixels[3];
    struct noisy *noisy[3];
    struct pixel *averaged; /* the result */
};

/* Returns the average of pixel (x, y) and its similar neighbours. */
static struct pixel average(const struct image *mean, const struct rows *rows, uint32_t x,
                            uint32_t y)
{
    static const float distance_weights[] = { 1.0f, 0.607f, 0.368f }; /* Gaussian of sigma 1 */
    const struct around a = around(mean, x, y);
    struct pixel sum = { 0 };
    float weights = 0.0f;
    for (uint32_t v = a.top; v <= a.bottom; v++) {
        for (uint32_t u = a.left; u <= a.right; u++) {
            const float weight = distance_weights[(u != x) + (v != y)] *
                                 similarity(&rows->noisy[y % 3][x], &rows->noisy[v % 3][u]);
            for (uint32_t c = 0; c < 5; c++)
                sum.values[c] += weight * rows->pixels[v % 3][u].values[c];
            weights += weight;
        }
    }
    for (uint32_t c = 0; c < 5; c++)
        sum.values[c] /= weights;
    return sum;
}

/* Denoises a row. */
static void smooth_row(struct image *mean, const struct rows *rows, uint32_t y)
{
    bool is_noisy = false;
    for (uint32_t x = 0; x < mean->width; x++) {
        const float share = fminf(sqrtf(rows->noisy[y % 3][x].variance) / noise - 1.0f, 1.0f);
        struct pixel *pixel = &rows->averaged[x];
        *pixel = rows->pixels[y % 3][x];
        if (!(share > 0.0f))
            continue;
        const struct pixel smoothed = average(mean, rows, x, y);
        for (uint32_t c = 0; c < 5; c++)
            pixel->values[c] += share * (smoothed.values[c] - pixel->values[c]);
        is_noisy = true;
    }
    if (is_noisy)
        write_row(mean, y, rows->averaged);
}

bool weighted_mean_denoise(struct image *mean, float scale)
{
    if (!image_find(mean, plane_name(VARIANCE)))
        return true;
    const size_t width = mean->width;
    struct pixel *pixels = calloc(4 * width + 1, sizeof(*pixels));
    struct noisy *noisy = calloc(3 * width + 1, sizeof(*noisy));
    const bool has_memory = pixels && noisy;
    if (has_memory) {
        const struct rows rows = { { pixels, pixels + width, pixels + 2 * width },
                                   { noisy, noisy + width, noisy + 2 * width },
                                   pixels + 3 * width };
        for (uint32_t y = 0; y < mean->height; y++) {
            for (uint32_t next = y ? y + 1 : 0; next <= y + 1 && next < mean->height; next++) {
                weigh_row(mean, next, scale, rows.pixels[next % 3]);
                find_noise(mean, next, rows.pixels[next % 3], scale, rows.noisy[next % 3]);
            }
            smooth_row(mean, &rows, y);
        }
    }
    free(noisy);
    free(pixels);
    return has_memory;
}

bool weighted_mean_reconstruct(struct image *mean, float scale)
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

bool weighted_mean_filter(struct image *mean, float scale)
{
    return weighted_mean_reconstruct(mean, scale) && weighted_mean_denoise(mean, scale);
}
