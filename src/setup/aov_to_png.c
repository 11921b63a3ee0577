/* aov_to_png.c: converts float layers to 8-bit or 16-bit pixels for PNG files. */
#include "src/setup/aov_to_png.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/ocio_view.h"
#include "src/file/srgb.h"
#include "src/tech/output/tonemap.h"

/* Planes of a layer, and the values that are shown as black and white. */
struct source {
    const float *planes[3];
    uint32_t count; /* number of planes; one is shown as grey, two as red and green */
    float minimum[3], maximum[3];
};

const struct frame_layer *layer_image_find(const char *name)
{
    const struct frame_layer *layer;
    for (size_t i = 0; (layer = techniques_layer(i)); i++) {
        if (!strcmp(layer->name, name))
            return layer;
    }
    return NULL;
}

uint64_t layer_image_bit(const struct frame_layer *layer)
{
    for (size_t i = 0; layer && techniques_layer(i); i++) {
        if (techniques_layer(i) == layer)
            return UINT64_C(1) << i;
    }
    return 0;
}

static uint8_t quantise(float x)
{
    return (uint8_t)(fminf(fmaxf(x, 0.0f), 1.0f) * 255.0f + 0.5f); /* NaN becomes 0 */
}

static uint16_t quantise_16(float x)
{
    return (uint16_t)(fminf(fmaxf(x, 0.0f), 1.0f) * 65535.0f + 0.5f);
}

static bool has_value(const struct source *source, size_t i)
{
    bool any = false;
    for (uint32_t p = 0; p < source->count; p++) {
        const float x = source->planes[p][i];
        if (!isfinite(x) || x >= 1e10f)
            return false;
        any = any || x != 0.0f;
    }
    return any;
}

static void find_range(struct source *source, size_t pixels)
{
    for (uint32_t p = 0; p < source->count; p++) {
        source->minimum[p] = INFINITY;
        source->maximum[p] = -INFINITY;
    }
    for (size_t i = 0; i < pixels; i++) {
        for (uint32_t p = 0; p < source->count && has_value(source, i); p++) {
            source->minimum[p] = fminf(source->minimum[p], source->planes[p][i]);
            source->maximum[p] = fmaxf(source->maximum[p], source->planes[p][i]);
        }
    }
}

/* Maps a value from its plane's range to 0..1. Returns 1 if the range is empty. */
static float stretch(const struct source *source, uint32_t p, float x)
{
    const float width = source->maximum[p] - source->minimum[p];
    return width > 0.0f ? (x - source->minimum[p]) / width : 1.0f;
}

static float shade(const struct source *source, enum frame_shown shown, uint32_t p, size_t i)
{
    const float darkest = 0.125f; /* shade of the darkest value; black marks missing values */
    const float x = source->planes[p][i];
    switch (shown) {
    case FRAME_SHOWN_AMOUNT:
        return darkest + (1.0f - darkest) * stretch(source, p, x);
    case FRAME_SHOWN_DISTANCE:
        if (source->minimum[p] == source->maximum[p])
            return 1.0f;
        return 1.0f - (1.0f - darkest) * stretch(source, p, x);
    case FRAME_SHOWN_DIRECTION:
        return 0.5f + 0.5f * x;
    case FRAME_SHOWN_POSITION:
        return stretch(source, p, x);
    case FRAME_SHOWN_COLOR:
        break;
    }
    return tonemap_srgb(x);
}

static struct source open_source(const struct image *image, const struct frame_layer *layer)
{
    struct source source = { .count = 1 };
    while (source.count < 3 && layer->planes[source.count])
        source.count++;
    for (uint32_t p = 0; p < source.count; p++)
        source.planes[p] = image_find(image, layer->planes[p]);
    find_range(&source, (size_t)image->width * image->height);
    return source;
}

/* Computes the shown colour of a layer's pixel. Colours of 8 bits are encoded as in shaders. */
static void show_layer(const struct source *source, enum frame_shown shown, size_t i, bool is_16,
                       float rgba[static 4])
{
    const bool is_color = shown == FRAME_SHOWN_COLOR;
    const uint32_t count = !is_color && !has_value(source, i) ? 0 : source->count == 2 ? 2 : 3;
    rgba[0] = rgba[1] = rgba[2] = 0.0f;
    rgba[3] = 1.0f;
    for (uint32_t c = 0; c < count; c++) {
        const uint32_t p = c % source->count;
        rgba[c] =
            is_color && is_16 ? srgb_encode(source->planes[p][i]) : shade(source, shown, p, i);
    }
}

/* Tone-maps a pixel of the layer `beauty`, or applies `view`, which may be NULL. The result has
 * straight (unpremultiplied) alpha. */
static void show_beauty(const float *const planes[static 4], size_t i, struct tonemap_params params,
                        const struct ocio_view *view, float rgba[static 4])
{
    const float alpha = planes[3][i];
    const float unpremultiply = alpha > 0.0f && alpha < 1.0f ? 1.0f / alpha : 1.0f;
    const vec3s radiance = { { planes[0][i], planes[1][i], planes[2][i] } };
    params.gain *= unpremultiply;
    rgba[3] = alpha;
    if (view) {
        ocio_view_apply(view, glms_vec3_scale(radiance, params.gain).raw, rgba);
        return;
    }
    const vec3s shown = tonemap_apply(radiance, params);
    for (size_t c = 0; c < 3; c++)
        rgba[c] = srgb_encode(shown.raw[c]);
}

/* Returns a pseudo-random number from 0 to 1, hashed from a pixel index and a seed. */
static float noise(size_t i, uint32_t seed)
{
    uint32_t h = ((uint32_t)i * 0x9e3779b9u) ^ (seed * 0x85ebca6bu);
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return (float)((h ^ h >> 16) >> 8) / 16777216.0f;
}

/* Dithers a value, except black and white, with triangular noise of plus or minus one step. Dither
 * hides banding. The mean and variance of its error do not depend on the value (Lipshitz,
 * Wannamaker and Vanderkooy 1992). */
static float dither_value(float x, size_t i, uint32_t channel)
{
    if (!(x > 0.0f && x < 1.0f))
        return x;
    return x + (noise(i, 2 * channel) + noise(i, 2 * channel + 1) - 1.0f) / 255.0f;
}

bool layer_image_is_dithered(const struct settings *settings)
{
    const struct tonemap_values *values = settings_of(settings, &tonemap_settings);
    return values->dither;
}

/* Writes a pixel of 8 or 16 bits per channel, or both. Arrays that are NULL are left out. */
static void write_pixel(const float shown[4], size_t i, bool is_dithered, uint8_t *bytes,
                        uint16_t *words)
{
    for (uint32_t c = 0; c < 4; c++) {
        if (words)
            words[i * 4 + c] = quantise_16(shown[c]);
        if (bytes)
            bytes[i * 4 + c] =
                quantise(is_dithered && c < 3 ? dither_value(shown[c], i, c) : shown[c]);
    }
}

bool layer_image_show(const struct image *image, const struct frame_layer *layer,
                      const struct settings *settings, const struct ocio_view *view, uint8_t **rgba,
                      uint16_t **rgba_16)
{
    const struct tonemap_params params = tonemap_params_of(settings);
    const size_t pixels = (size_t)image->width * image->height;
    const bool is_dithered = !layer && layer_image_is_dithered(settings);
    const struct source source = layer ? open_source(image, layer) : (struct source){ 0 };
    const float *beauty[4];
    uint8_t *bytes = rgba ? calloc(pixels, 4) : NULL;
    uint16_t *words = rgba_16 ? calloc(pixels, 4 * sizeof(*words)) : NULL;
    for (size_t p = 0; p < 4; p++)
        beauty[p] = image_find(image, frame_beauty.planes[p]);
    for (size_t i = 0; i < pixels && (bytes || words); i++) {
        float shown[4];
        if (layer)
            show_layer(&source, layer->shown, i, words != NULL, shown);
        else
            show_beauty(beauty, i, params, view, shown);
        write_pixel(shown, i, is_dithered, bytes, words);
    }
    if (rgba)
        *rgba = bytes;
    if (rgba_16)
        *rgba_16 = words;
    if (bytes || words)
        return true;
    log_error("out of memory");
    return false;
}
