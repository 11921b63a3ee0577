/* buffers.c: converts rendered layers to buffers of the caller. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lib/lib.h"
#include "src/setup/aov_to_png.h"

static const size_t type_sizes[] = {
    [FIRN_FLOAT32] = sizeof(float),
    [FIRN_UINT8] = sizeof(uint8_t),
    [FIRN_UINT16] = sizeof(uint16_t),
    [FIRN_UINT32] = sizeof(uint32_t),
};

enum {
    TYPE_COUNT = sizeof(type_sizes) / sizeof(type_sizes[0])
};

/* Validated buffer with explicit strides. */
struct target {
    const struct frame_layer *layer;
    bool is_display;
    char *data;
    uint32_t type, channels;
    ptrdiff_t pixel_stride, row_stride;
};

/* Returns the index of a layer that the renderer draws, or -1. */
static int find_drawn(const firn_renderer *r, const char *name)
{
    for (uint32_t i = 0; name && lib_layer(i); i++) {
        const bool is_drawn = i == 0   ? r->has_beauty
                              : i == 1 ? r->has_display
                                       : (r->layers & layer_image_bit(lib_layer(i))) != 0;
        if (is_drawn && !strcmp(lib_layer(i)->name, name))
            return (int)i;
    }
    return -1;
}

const struct firn_buffer *lib_buffer_at(const struct firn_buffer *buffers, size_t index)
{
    return (const struct firn_buffer *)((const char *)buffers + index * buffers->size);
}

static enum status read_target(struct target *target, const firn_renderer *r,
                               const struct firn_buffer *given)
{
    struct firn_buffer b;
    enum status status = lib_read(&b, sizeof(b), given, "buffer");
    if (status != STATUS_OK)
        return status;
    const int index = find_drawn(r, b.layer);
    if (index < 0) {
        log_error("buffer: the renderer was created without layer '%.64s'",
                  b.layer ? b.layer : "NULL");
        return STATUS_USAGE;
    }
    const struct frame_layer *layer = lib_layer((uint32_t)index);
    const uint32_t all = frame_layer_plane_count(layer);
    if (b.type >= TYPE_COUNT || b.channels > all || !b.data ||
        (index == 1 && b.type == FIRN_UINT32)) {
        log_error(
            "buffer of layer '%s': expected data, a firn_type that the layer has, and at most "
            "%u channels; got type %u and %u channels",
            layer->name, all, b.type, b.channels);
        return STATUS_USAGE;
    }
    *target =
        (struct target){ layer,          index == 1,  b.data, b.type, b.channels ? b.channels : all,
                         b.pixel_stride, b.row_stride };
    if (!target->pixel_stride)
        target->pixel_stride = (ptrdiff_t)(target->channels * type_sizes[b.type]);
    if (!target->row_stride)
        target->row_stride = target->pixel_stride * (ptrdiff_t)r->width;
    return STATUS_OK;
}

enum status lib_buffers_check(const firn_renderer *renderer, const struct firn_buffer *buffers,
                              size_t count)
{
    enum status status = count ? lib_require(buffers, "buffers") : STATUS_OK;
    for (size_t i = 0; i < count && status == STATUS_OK; i++) {
        struct target target;
        status = read_target(&target, renderer, lib_buffer_at(buffers, i));
    }
    return status;
}

/* Converts a number to an integer from 0 to max. */
static uint32_t to_integer(float value, double max)
{
    const double rounded = (double)value + 0.5;
    return !(rounded >= 1.0) ? 0 : rounded >= max ? (uint32_t)max : (uint32_t)rounded;
}

static void put_integer(char *to, uint32_t type, float value)
{
    const uint32_t integer = to_integer(value, type == FIRN_UINT8    ? UINT8_MAX
                                               : type == FIRN_UINT16 ? UINT16_MAX
                                                                     : (double)UINT32_MAX);
    const uint8_t byte = (uint8_t)integer;
    const uint16_t half = (uint16_t)integer;
    if (type == FIRN_UINT8)
        memcpy(to, &byte, sizeof(byte));
    else if (type == FIRN_UINT16)
        memcpy(to, &half, sizeof(half));
    else
        memcpy(to, &integer, sizeof(integer));
}

/* Writes a row of one channel; zeros if `from` is NULL. */
static void put_row(const struct target *target, char *to, const float *from, size_t count)
{
    const ptrdiff_t stride = target->pixel_stride;
    const bool is_float = target->type == FIRN_FLOAT32;
    for (size_t x = 0; from && is_float && x < count; x++, to += stride)
        memcpy(to, &from[x], sizeof(from[x]));
    for (size_t x = 0; from && !is_float && x < count; x++, to += stride)
        put_integer(to, target->type, from[x]);
    for (size_t x = 0; !from && x < count; x++, to += stride)
        memset(to, 0, type_sizes[target->type]);
}

/* Writes a layer; 0 if the refraction model has no such layer. */
static void write_layer(const struct target *target, const struct image *image)
{
    const size_t size = type_sizes[target->type];
    const float *planes[FRAME_LAYER_PLANES];
    for (uint32_t c = 0; c < target->channels; c++)
        planes[c] = image_find(image, target->layer->planes[c]);
    /* Rows in the outer loop: all channels of a row are written while it is in the cache. */
    for (size_t y = 0; y < image->height; y++) {
        char *to = target->data + (ptrdiff_t)y * target->row_stride;
        for (uint32_t c = 0; c < target->channels; c++)
            put_row(target, to + c * size, planes[c] ? &planes[c][y * image->width] : NULL,
                    image->width);
    }
}

/* Encodes the layer `display` with 8 or 16 bits per channel, as in PNG files. */
static enum status make_display(const struct lib_shown *shown, struct render_result *result,
                                bool is_16)
{
    const struct settings *settings = &shown->settings;
    const bool is_shown =
        is_16 ? !result->rgba_16
              : !result->rgba || layer_image_is_dithered(settings) || shown->no_background;
    if (!is_shown)
        return STATUS_OK;
    if (!is_16) {
        free(result->rgba);
        result->rgba = NULL;
    }
    return layer_image_show(render_result_display(result), NULL, settings, NULL,
                            is_16 ? NULL : &result->rgba, is_16 ? &result->rgba_16 : NULL)
               ? STATUS_OK
               : STATUS_TRY_AGAIN;
}

static void write_display(const struct target *target, const struct render_result *result,
                          uint32_t width, uint32_t height)
{
    const size_t size = type_sizes[target->type];
    for (size_t i = 0; i < (size_t)width * height; i++) {
        char *to = target->data + (ptrdiff_t)(i / width) * target->row_stride +
                   (ptrdiff_t)(i % width) * target->pixel_stride;
        for (size_t c = 0; c < target->channels; c++, to += size) {
            if (target->type == FIRN_UINT8) {
                *to = (char)result->rgba[4 * i + c];
                continue;
            }
            const uint16_t value = result->rgba_16[4 * i + c];
            const float fraction = (float)value / 65535.0f;
            if (target->type == FIRN_UINT16)
                memcpy(to, &value, sizeof(value));
            else
                memcpy(to, &fraction, sizeof(fraction));
        }
    }
}

struct lib_shown lib_shown_of(const firn_renderer *r)
{
    return (struct lib_shown){ r->image.scene.settings, r->image.scene.no_background };
}

enum status lib_buffers_write(const firn_renderer *r, const struct firn_buffer *buffers,
                              size_t count, const struct lib_shown *shown,
                              struct render_result *result)
{
    struct target target;
    for (size_t i = 0; i < count; i++) {
        enum status status = read_target(&target, r, lib_buffer_at(buffers, i));
        if (status == STATUS_OK && target.is_display)
            status = make_display(shown, result, target.type != FIRN_UINT8);
        if (status != STATUS_OK)
            return status;
        if (target.is_display)
            write_display(&target, result, r->width, r->height);
        else
            write_layer(&target, &result->image);
    }
    return STATUS_OK;
}
