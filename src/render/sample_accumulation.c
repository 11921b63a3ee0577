/* sample_accumulation.c: adds samples, which are half or single floats, to float image planes. */
#include "src/render/sample_accumulation.h"
#include <assert.h>
#include <math.h>
#include <string.h>
#include "src/file/half_float.h"

static uint32_t channel_count(VkFormat format)
{
    return format == VK_FORMAT_R32_SFLOAT ? 1 : 4;
}

static bool is_half(VkFormat format)
{
    return format == VK_FORMAT_R16G16B16A16_SFLOAT;
}

bool accumulate_add_planes(struct image *image, const struct frame_layer *layer)
{
    for (uint32_t p = 0; p < frame_layer_plane_count(layer); p++) {
        if (!image_add_plane(image, layer->planes[p], layer->half))
            return false;
        image->planes[image->plane_count - 1].integer = layer->integer;
    }
    return true;
}

static void add_half(float *plane, size_t count, const void *texels, uint32_t channel)
{
    const uint16_t *source = texels;
    for (size_t i = 0; i < count; i++)
        plane[i] += half_to_float(source[i * 4 + channel]);
}

/* Adds a channel of `count` texels to a plane. The first sample replaces its content; -0 as 0. */
static void add_float(float *restrict plane, size_t count, const float *restrict source,
                      uint32_t channels, bool is_first)
{
    for (size_t i = 0; i < count; i++)
        plane[i] = (is_first ? 0.0f : plane[i]) + source[i * channels];
}

/* As add_float() for three channels of four, in one pass over the texels. */
static void add_float3(float *const planes[static 3], size_t first, size_t count,
                       const float *restrict source, bool is_first)
{
    float *restrict x = &planes[0][first], *restrict y = &planes[1][first];
    float *restrict z = &planes[2][first];
    for (size_t i = 0; i < count; i++, source += 4) {
        x[i] = (is_first ? 0.0f : x[i]) + source[0];
        y[i] = (is_first ? 0.0f : y[i]) + source[1];
        z[i] = (is_first ? 0.0f : z[i]) + source[2];
    }
}

void accumulate_sample(struct image *image, const struct tile *tile,
                       const struct frame_layer *layer, const void *texels, uint32_t sample)
{
    const VkFormat format = layer->image->format;
    const size_t size = rg_format_info(format)->size;
    const uint32_t channels = channel_count(format);
    assert(is_half(format) || size == channels * sizeof(float));
    if (sample && !layer->mean)
        return;
    float *planes[FRAME_LAYER_PLANES];
    const uint32_t count = frame_layer_plane_count(layer);
    for (uint32_t p = 0; p < count; p++)
        planes[p] = image_find(image, layer->planes[p]);
    /* Rows in the outer loop: all channels of a row are read while it is in the cache. */
    for (uint32_t y = 0; y < tile->height; y++) {
        const size_t first = (size_t)(tile->y + y) * image->width + tile->x;
        const char *row = (const char *)texels + size * tile->width * y;
        const float *source = (const float *)(const void *)row + layer->first_channel;
        if (count == 3 && channels == 4 && !is_half(format)) {
            add_float3(planes, first, tile->width, source, !sample);
            continue;
        }
        for (uint32_t p = 0; p < count; p++) {
            if (is_half(format))
                add_half(&planes[p][first], tile->width, row, layer->first_channel + p);
            else
                add_float(&planes[p][first], tile->width, source + p, channels, !sample);
        }
    }
}

void accumulate_mean(struct image *image, const struct frame_layer *layer, uint32_t samples)
{
    size_t count = (size_t)image->width * image->height;
    for (uint32_t p = 0; p < frame_layer_plane_count(layer) && layer->mean && samples > 1; p++) {
        float *plane = image_find(image, layer->planes[p]);
        for (size_t i = 0; i < count; i++)
            plane[i] /= (float)samples;
    }
}
