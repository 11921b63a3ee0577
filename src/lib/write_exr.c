/* write_exr.c: firn_write_exr(): writes arrays of the caller as an EXR file. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/file/atomic_file.h"
#include "src/file/exr.h"
#include "src/lib/lib.h"

/* Writes the name of a channel, as `firn render` does: R, G, B, A for beauty; the planes of a known
 * layer; else NAME for a single channel, or NAME.R ... for several. */
static void name_channel(char *name, const struct firn_buffer *buffer, uint32_t channel)
{
    const struct frame_layer *known = NULL;
    for (uint32_t i = 0; lib_layer(i) && !known; i++)
        known = i != 1 && !strcmp(lib_layer(i)->name, buffer->layer) ? lib_layer(i) : NULL;
    if (known && channel < frame_layer_plane_count(known))
        snprintf(name, IMAGE_NAME_SIZE, "%s", known->planes[channel]);
    else if (buffer->channels == 1)
        snprintf(name, IMAGE_NAME_SIZE, "%.61s", buffer->layer);
    else if (buffer->channels <= 4)
        snprintf(name, IMAGE_NAME_SIZE, "%.61s.%c", buffer->layer, "RGBA"[channel]);
    else
        snprintf(name, IMAGE_NAME_SIZE, "%.52s.%u", buffer->layer, channel);
}

static float value_at(const char *from, uint32_t type)
{
    float value;
    uint32_t integer;
    if (type == FIRN_UINT32) {
        memcpy(&integer, from, sizeof(integer));
        return (float)integer;
    }
    memcpy(&value, from, sizeof(value));
    return value;
}

static enum status add_planes(struct image *image, const struct firn_buffer *buffer)
{
    const ptrdiff_t pixel =
        buffer->pixel_stride ? buffer->pixel_stride : (ptrdiff_t)(4 * (size_t)buffer->channels);
    const ptrdiff_t row = buffer->row_stride ? buffer->row_stride : pixel * (ptrdiff_t)image->width;
    for (uint32_t c = 0; c < buffer->channels; c++) {
        char name[IMAGE_NAME_SIZE];
        name_channel(name, buffer, c);
        if (image_find(image, name)) {
            log_error("layer '%.61s' is given twice", buffer->layer);
            return STATUS_USAGE;
        }
        float *texels = image_add_plane(image, name, false);
        if (!texels)
            return log_out_of_memory(name);
        image->planes[image->plane_count - 1].integer = buffer->type == FIRN_UINT32;
        for (size_t y = 0; y < image->height; y++) {
            const char *from = (const char *)buffer->data + (ptrdiff_t)y * row + (ptrdiff_t)(4 * c);
            for (size_t x = 0; x < image->width; x++, from += pixel)
                texels[y * image->width + x] = value_at(from, buffer->type);
        }
    }
    return STATUS_OK;
}

static enum status add_buffer(struct image *image, const struct firn_buffer *given)
{
    struct firn_buffer buffer;
    enum status status = lib_read(&buffer, sizeof(buffer), given, "buffer");
    if (status != STATUS_OK)
        return status;
    const bool has_type = buffer.type == FIRN_FLOAT32 || buffer.type == FIRN_UINT32;
    if (!buffer.layer || !*buffer.layer || !buffer.data || !has_type || !buffer.channels ||
        buffer.channels > FRAME_LAYER_PLANES) {
        log_error("buffer '%.61s': expected a name, data of FIRN_FLOAT32 or FIRN_UINT32, and 1 to "
                  "8 channels",
                  buffer.layer ? buffer.layer : "");
        return STATUS_USAGE;
    }
    return add_planes(image, &buffer);
}

static enum status write_exr(const char *path, uint32_t width, uint32_t height,
                             const struct firn_buffer *buffers, size_t count)
{
    enum status status = lib_require(path, "path");
    if (status == STATUS_OK)
        status = lib_require(buffers, "buffers");
    if (status == STATUS_OK &&
        (!count || !width || !height || width > IMAGE_MAX_SIDE || height > IMAGE_MAX_SIDE)) {
        log_error("%s: expected at least one buffer and a size from 1x1 to %dx%d", path,
                  IMAGE_MAX_SIDE, IMAGE_MAX_SIDE);
        status = STATUS_USAGE;
    }
    struct image image;
    image_init(&image, width, height);
    for (size_t i = 0; i < count && status == STATUS_OK; i++)
        status = add_buffer(&image, lib_buffer_at(buffers, i));
    void *data = NULL;
    size_t size = 0;
    if (status == STATUS_OK)
        status = exr_encode(&image, &(struct exr_header){ 0 }, &data, &size);
    image_finish(&image);
    if (status == STATUS_OK)
        status = file_io_write(path, data, size);
    free(data);
    return status;
}

firn_status firn_write_exr(const char *path, uint32_t width, uint32_t height,
                           const struct firn_buffer *buffers, size_t count)
{
    struct lib_call call;
    lib_enter_alone(&call);
    return lib_leave(&call, write_exr(path, width, height, buffers, count));
}
