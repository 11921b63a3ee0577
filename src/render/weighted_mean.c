/* weighted_mean.c: luminance-weighted mean of a pixel's samples, for PNG files and windows. */
#include "src/render/weighted_mean.h"
#include <math.h>
#include "src/file/half_float.h"

enum {
    WEIGHT = 4, /* plane after those of frame_beauty */
    PLANE_COUNT,
};

const struct frame_layer weighted_mean_alpha = { .planes = { "A" }, .mean = true };

float weighted_mean_scale(const struct settings *settings)
{
    const bool is_linear = settings_get(settings, settings_find("tonemap.resolve")) > 0.0;
    return is_linear ? 0.0f
                     : exp2f((float)settings_get(settings, settings_find("tonemap.exposure")));
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
