/* exr_write.c: encodes OpenEXR files in memory, since the library reports no write errors. */
#include <OpenEXR/openexr.h>
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/exr.h"
#include "src/file/half_float.h"

/* Maximum length of names, because old OpenEXR readers reject files with longer ones. */
enum {
    SHORT_NAME_MAX = 31
};

struct sink {
    unsigned char *bytes;
    size_t size, capacity;
    bool out_of_memory;
};

/* Writes bytes at an offset of the file in memory. The OpenEXR library calls this function. */
static int64_t sink_write(exr_const_context_t context, void *user, const void *bytes, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t report)
{
    struct sink *sink = user;
    const size_t end = offset + size;

    (void)context;
    (void)report;
    if (end > sink->capacity) {
        const size_t capacity = end + end / 2;
        unsigned char *grown = realloc(sink->bytes, capacity);
        if (!grown) {
            sink->out_of_memory = true;
            return -1;
        }
        memset(grown + sink->capacity, 0, capacity - sink->capacity);
        sink->bytes = grown;
        sink->capacity = capacity;
    }
    memcpy(sink->bytes + offset, bytes, size);
    if (end > sink->size)
        sink->size = end;
    return (int64_t)size;
}

/* Suppresses error output of the OpenEXR library, because its result codes suffice. */
static void ignore_message(exr_const_context_t context, exr_result_t code, const char *text)
{
    (void)context;
    (void)code;
    (void)text;
}

static bool has_long_names(const struct image *image, const struct exr_header *header)
{
    for (uint32_t i = 0; i < image->plane_count; i++) {
        if (strlen(image->planes[i].name) > SHORT_NAME_MAX)
            return true;
    }
    for (uint32_t i = 0; i < header->text_count; i++) {
        if (strlen(header->texts[i].name) > SHORT_NAME_MAX)
            return true;
    }
    return false;
}

static exr_result_t declare_matrix(exr_context_t context, const char *name, const float *matrix)
{
    exr_attr_m44f_t value;

    if (!matrix)
        return EXR_ERR_SUCCESS;
    memcpy(value.m, matrix, sizeof(value.m));
    return exr_attr_set_m44f(context, 0, name, &value);
}

/* Writes the frame rate as a fraction. NTSC rates such as 23.976 are multiples of 1000 / 1001. */
static exr_result_t declare_rate(exr_context_t context, double rate)
{
    const double whole = round(rate), television = round(rate * 1.001);
    exr_attr_rational_t value = { (int32_t)lround(rate * 1000.0), 1000 };

    if (!(rate > 0.0))
        return EXR_ERR_SUCCESS;
    if (fabs(rate - whole) < 1e-6)
        value = (exr_attr_rational_t){ (int32_t)whole, 1 };
    else if (fabs(rate - television / 1.001) < 1e-3 && television > 0.0)
        value = (exr_attr_rational_t){ (int32_t)television * 1000, 1001 };
    return exr_attr_set_rational(context, 0, "framesPerSecond", &value);
}

static exr_result_t declare_attributes(exr_context_t context, const struct exr_header *header)
{
    /* Rec.709 primaries and white point (ITU-R BT.709-6, items 1.3 and 1.4). */
    static const exr_attr_chromaticities_t rec709 = {
        .red_x = 0.64f,
        .red_y = 0.33f,
        .green_x = 0.3f,
        .green_y = 0.6f,
        .blue_x = 0.15f,
        .blue_y = 0.06f,
        .white_x = 0.3127f,
        .white_y = 0.329f,
    };
    exr_result_t result = exr_attr_set_chromaticities(context, 0, "chromaticities", &rec709);

    if (result == EXR_ERR_SUCCESS)
        result = declare_matrix(context, "worldToCamera", header->world_to_camera);
    if (result == EXR_ERR_SUCCESS)
        result = declare_matrix(context, "worldToNDC", header->world_to_ndc);
    if (result == EXR_ERR_SUCCESS)
        result = declare_rate(context, header->frames_per_second);
    for (uint32_t i = 0; i < header->text_count && result == EXR_ERR_SUCCESS; i++) {
        const struct image_text *text = &header->texts[i];
        result = exr_attr_set_string(context, 0, text->name, text->value);
    }
    return result;
}

/* Sets the data and the display window, which are equal if `window` has no size. */
static exr_result_t declare_windows(exr_context_t context, int part, const struct image *image,
                                    const struct image_window *window)
{
    const exr_attr_v2f_t center = { .x = 0.0f, .y = 0.0f };
    const int32_t x = (int32_t)window->x, y = (int32_t)window->y;
    const exr_attr_box2i_t data = {
        .min = { .x = x, .y = y },
        .max = { .x = x + (int32_t)image->width - 1, .y = y + (int32_t)image->height - 1 },
    };
    exr_attr_box2i_t display = data;

    if (window->width)
        display = (exr_attr_box2i_t){
            .max = { .x = (int32_t)window->width - 1, .y = (int32_t)window->height - 1 },
        };
    return exr_initialize_required_attr(context, part, &display, &data, 1.0f, &center, 1.0f,
                                        EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP);
}

static exr_result_t declare_part(exr_context_t context, const struct image *image,
                                 const struct image_window *window)
{
    int part;
    exr_result_t result = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part);

    if (result == EXR_ERR_SUCCESS)
        result = declare_windows(context, part, image, window);
    for (uint32_t i = 0; i < image->plane_count && result == EXR_ERR_SUCCESS; i++) {
        const struct image_plane *plane = &image->planes[i];
        result = exr_add_channel(context, part, plane->name,
                                 plane->half      ? EXR_PIXEL_HALF
                                 : plane->integer ? EXR_PIXEL_UINT
                                                  : EXR_PIXEL_FLOAT,
                                 EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    }
    return result;
}

static const struct image_plane *find_plane(const struct image *image, const char *name)
{
    const struct image_plane *plane = image->planes;
    while (strcmp(plane->name, name) != 0)
        plane++;
    return plane;
}

/* Source of texels. */
struct origin {
    const struct image *image; /* size and planes */
    uint32_t y;                /* display window row of the image's top */
    exr_rows_fn *fill;
    void *user;
    struct image rows;  /* row group filled by `fill` */
    enum status status; /* last result of `fill` */
};

/* Rounds the texels of an integer plane in place to 32-bit unsigned integers. NaN becomes 0. */
static void make_integers(float *texels, size_t count)
{
    for (size_t t = 0; t < count; t++) {
        const double rounded = (double)texels[t] + 0.5;
        const uint32_t integer = !(rounded >= 1.0)               ? 0
                                 : rounded >= (double)UINT32_MAX ? UINT32_MAX
                                                                 : (uint32_t)rounded;
        memcpy(&texels[t], &integer, sizeof(integer));
    }
}

/* Gives the encoder pointers to the rows. Half planes are converted into `halves`. */
static void set_channels(exr_encode_pipeline_t *pipeline, const struct image *rows,
                         uint16_t *halves)
{
    for (int c = 0; c < pipeline->channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[c];
        const struct image_plane *plane = find_plane(rows, channel->channel_name);
        const size_t count = (size_t)channel->width * (size_t)channel->height;

        if (plane->half) {
            for (size_t t = 0; t < count; t++)
                halves[t] = half_from_float(plane->texels[t]);
            channel->encode_from_ptr = (const uint8_t *)halves;
            channel->user_pixel_stride = sizeof(*halves);
            halves += count;
        } else {
            if (plane->integer)
                make_integers(plane->texels, count);
            channel->encode_from_ptr = (const uint8_t *)plane->texels;
            channel->user_pixel_stride = sizeof(*plane->texels);
        }
        channel->user_line_stride = channel->width * channel->user_pixel_stride;
    }
}

typedef exr_result_t compress_fn(exr_encode_pipeline_t *pipeline);

struct compressor {
    compress_fn *compress; /* the library's function */
};

/*
 * Calls the library's compressor. If compression leaves a chunk's length unchanged, stores the
 * chunk uncompressed, because readers expect it. OpenEXR 3.1.5 would store compressed data.
 */
static exr_result_t compress_chunk(exr_encode_pipeline_t *pipeline)
{
    const struct compressor *compressor = pipeline->encoding_user_data;
    const exr_result_t result = compressor->compress(pipeline);

    if (result == EXR_ERR_SUCCESS && pipeline->compressed_bytes == pipeline->packed_bytes)
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
    return result;
}

/* Encodes a chunk with a new pipeline, because a reused one has stale pointers and buffers. */
static exr_result_t write_chunk(exr_context_t context, const struct origin *origin, uint32_t y,
                                uint16_t *halves)
{
    exr_chunk_info_t chunk;
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    struct compressor compressor;
    exr_result_t result = exr_write_scanline_chunk_info(context, 0, (int)(origin->y + y), &chunk);

    if (result != EXR_ERR_SUCCESS)
        return result;
    result = exr_encoding_initialize(context, 0, &chunk, &pipeline);
    if (result == EXR_ERR_SUCCESS) {
        set_channels(&pipeline, &origin->rows, halves);
        result = exr_encoding_choose_default_routines(context, 0, &pipeline);
    }
    if (result == EXR_ERR_SUCCESS) {
        compressor.compress = pipeline.compress_fn;
        pipeline.encoding_user_data = &compressor;
        pipeline.compress_fn = compress_chunk;
        result = exr_encoding_run(context, 0, &pipeline);
    }
    exr_encoding_destroy(context, &pipeline);
    return result;
}

/* Fills the next group of rows, which may be smaller at the end of the image. */
static exr_result_t fill_rows(struct origin *origin, uint32_t y, uint32_t lines)
{
    const uint32_t left = origin->image->height - y;
    origin->rows.height = left < lines ? left : lines;
    origin->status = origin->fill(origin->user, y, &origin->rows);
    return origin->status == STATUS_OK ? EXR_ERR_SUCCESS : EXR_ERR_READ_IO;
}

static exr_result_t write_chunks(exr_context_t context, struct origin *origin)
{
    const struct image *image = origin->image;
    int32_t lines;
    exr_result_t result = exr_get_scanlines_per_chunk(context, 0, &lines);

    if (result != EXR_ERR_SUCCESS)
        return result;
    const size_t plane_size = (size_t)lines * image->width * sizeof(uint16_t);
    uint16_t *halves = malloc(plane_size * image->plane_count);
    if (!halves || !image_init_like(&origin->rows, image, (uint32_t)lines))
        result = EXR_ERR_OUT_OF_MEMORY;
    for (uint32_t y = 0; y < image->height && result == EXR_ERR_SUCCESS; y += (uint32_t)lines) {
        result = fill_rows(origin, y, (uint32_t)lines);
        if (result == EXR_ERR_SUCCESS)
            result = write_chunk(context, origin, y, halves);
    }
    free(halves);
    return result;
}

static enum status encode(struct origin *origin, const struct exr_header *header, void **data,
                          size_t *size)
{
    const struct image *image = origin->image;
    struct sink sink = { 0 };
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t context = NULL;
    exr_result_t result, finished;

    assert(image->plane_count > 0 && image->plane_count <= IMAGE_MAX_PLANES);
    assert(image->width <= IMAGE_MAX_SIDE && image->height <= IMAGE_MAX_SIDE);
    assert(!header->window.width || (header->window.x + image->width <= header->window.width &&
                                     header->window.y + image->height <= header->window.height));
    *data = NULL;
    *size = 0;
    origin->y = header->window.y;
    start.error_handler_fn = ignore_message;
    start.user_data = &sink;
    start.write_fn = sink_write;
    start.zip_level = 2; /* takes a third less time than level 4; files are a tenth larger */
    result = exr_start_write(&context, "memory", EXR_WRITE_FILE_DIRECTLY, &start);
    if (result == EXR_ERR_SUCCESS && has_long_names(image, header))
        result = exr_set_longname_support(context, 1);
    if (result == EXR_ERR_SUCCESS)
        result = declare_part(context, image, &header->window);
    if (result == EXR_ERR_SUCCESS)
        result = declare_attributes(context, header);
    if (result == EXR_ERR_SUCCESS)
        result = exr_write_header(context);
    if (result == EXR_ERR_SUCCESS)
        result = write_chunks(context, origin);
    finished = exr_finish(&context);
    if (result == EXR_ERR_SUCCESS)
        result = finished;

    if (result == EXR_ERR_SUCCESS && !sink.out_of_memory) {
        *data = sink.bytes;
        *size = sink.size;
        return STATUS_OK;
    }
    free(sink.bytes);
    if (origin->status != STATUS_OK)
        return origin->status; /* already logged by `fill` */
    /* Encoding meets no corrupt data, so EXR_ERR_CORRUPT_CHUNK means that zlib lacks memory. */
    if (sink.out_of_memory || result == EXR_ERR_CORRUPT_CHUNK)
        result = EXR_ERR_OUT_OF_MEMORY;
    log_error("the EXR image could not be encoded: %s", exr_get_default_error_message(result));
    return result == EXR_ERR_OUT_OF_MEMORY ? STATUS_TRY_AGAIN : STATUS_FAILED;
}

enum status exr_encode_rows(const struct image *image, const struct exr_header *header,
                            exr_rows_fn *fill, void *user, void **data, size_t *size)
{
    struct origin origin = { .image = image, .fill = fill, .user = user };
    const enum status status = encode(&origin, header, data, size);
    image_finish(&origin.rows);
    return status;
}

static enum status copy_rows(void *user, uint32_t y, struct image *rows)
{
    const struct image *image = user;
    const size_t count = (size_t)rows->height * rows->width;
    for (uint32_t p = 0; p < rows->plane_count; p++)
        memcpy(rows->planes[p].texels, image->planes[p].texels + (size_t)y * rows->width,
               count * sizeof(float));
    return STATUS_OK;
}

enum status exr_encode(const struct image *image, const struct exr_header *header, void **data,
                       size_t *size)
{
    struct image source = *image; /* the callback's argument is not const */
    return exr_encode_rows(image, header, copy_rows, &source, data, size);
}
