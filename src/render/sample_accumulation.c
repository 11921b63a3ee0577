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

/* Adds a row of one channel of half texels to a row of a plane. The first sample replaces the row,
 * which spares reading untouched memory; 0 is added to it, as sums have no negative zeros. */
static void add_half(float *row, size_t count, const uint16_t *texels, uint32_t channels,
                     bool is_first)
{
    for (size_t i = 0; is_first && i < count; i++)
        row[i] = 0.0f + half_to_float(texels[i * channels]);
    for (size_t i = 0; !is_first && i < count; i++)
        row[i] += half_to_float(texels[i * channels]);
}

/* Same as add_half(), for single floats. */
static void add_float(float *row, size_t count, const float *texels, uint32_t channels,
                      bool is_first)
{
    for (size_t i = 0; is_first && i < count; i++)
        row[i] = 0.0f + texels[i * channels];
    for (size_t i = 0; !is_first && i < count; i++)
        row[i] += texels[i * channels];
}

void accumulate_sample(struct image *image, const struct tile *tile,
                       const struct frame_layer *layer, const void *texels, uint32_t sample)
{
    const VkFormat format = layer->image->format;
    const size_t size = rg_format_info(format)->size;
    const uint32_t channels = channel_count(format), plane_count = frame_layer_plane_count(layer);
    float *planes[FRAME_LAYER_PLANES];
    assert(is_half(format) || size == channels * sizeof(float));
    if (sample && !layer->mean)
        return;
    for (uint32_t p = 0; p < plane_count; p++)
        planes[p] = image_find(image, layer->planes[p]);
    for (uint32_t y = 0; y < tile->height; y++) { /* rows first: a row of texels fits the cache */
        const char *source = (const char *)texels + size * tile->width * y;
        for (uint32_t p = 0; p < plane_count; p++) {
            float *row = &planes[p][(size_t)(tile->y + y) * image->width + tile->x];
            const size_t channel = layer->first_channel + p;
            if (is_half(format))
                add_half(row, tile->width, (const uint16_t *)(const void *)source + channel,
                         channels, !sample);
            else
                add_float(row, tile->width, (const float *)(const void *)source + channel, channels,
                          !sample);
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
