/* exr_read.c: the first part of an OpenEXR file as planes of floats. */
#include <OpenEXR/openexr.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/image/exr.h"
#include "src/image/file.h"

struct source {
    FILE *file;
    int64_t size;
    char message[256];  /* the library's first error message */
    bool out_of_memory; /* for planes; the library reports it for some damaged chunks, too */
};

struct reader {
    exr_context_t context;
    exr_storage_t storage;
    exr_attr_box2i_t window; /* the data window: the picture */
    struct image *image;
    struct source *source;
};

static int64_t source_read(exr_const_context_t context, void *user, void *bytes, uint64_t size,
                           uint64_t offset, exr_stream_error_func_ptr_t report)
{
    struct source *source = user;

    (void)context;
    (void)report;
    if (offset > (uint64_t)source->size || fseeko(source->file, (off_t)offset, SEEK_SET) != 0)
        return -1;
    return (int64_t)fread(bytes, 1, size, source->file);
}

static int64_t source_size(exr_const_context_t context, void *user)
{
    const struct source *source = user;
    (void)context;
    return source->size;
}

static void keep_message(exr_const_context_t context, exr_result_t code, const char *text)
{
    void *user = NULL;

    (void)code;
    if (exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || !user)
        return;
    struct source *source = user;
    if (!source->message[0])
        snprintf(source->message, sizeof(source->message), "%s", text);
}

/* Allocates the library's buffers, zeroed, because it accepts some chunks that unpack to too few
 * bytes. */
static void *allocate(size_t size)
{
    return calloc(1, size);
}

static exr_result_t fault(struct reader *reader, const char *text)
{
    snprintf(reader->source->message, sizeof(reader->source->message), "%s", text);
    return EXR_ERR_FILE_BAD_HEADER;
}

static exr_result_t add_planes(struct reader *reader, const exr_attr_chlist_t *channels)
{
    for (int c = 0; c < channels->num_channels; c++) {
        const exr_attr_chlist_entry_t *channel = &channels->entries[c];
        if (channel->x_sampling != 1 || channel->y_sampling != 1)
            return fault(reader, "subsampled channels are not supported");
        if (strlen(channel->name.str) >= IMAGE_NAME_SIZE)
            return fault(reader, "a channel's name is too long");
        if (image_find(reader->image, channel->name.str))
            return fault(reader, "two channels have the same name");
        if (!image_add_plane(reader->image, channel->name.str,
                             channel->pixel_type == EXR_PIXEL_HALF)) {
            reader->source->out_of_memory = true;
            return EXR_ERR_OUT_OF_MEMORY;
        }
    }
    return EXR_ERR_SUCCESS;
}

/* Reads the size and the channels, but adds no planes, since the image may have fewer rows. */
static exr_result_t read_size(struct reader *reader, const exr_attr_chlist_t **list)
{
    const exr_attr_chlist_t *channels;
    exr_result_t result = exr_get_storage(reader->context, 0, &reader->storage);

    if (result == EXR_ERR_SUCCESS)
        result = exr_get_data_window(reader->context, 0, &reader->window);
    if (result == EXR_ERR_SUCCESS)
        result = exr_get_channels(reader->context, 0, &channels);
    if (result != EXR_ERR_SUCCESS)
        return result;
    if (reader->storage != EXR_STORAGE_SCANLINE && reader->storage != EXR_STORAGE_TILED)
        return fault(reader, "deep pictures are not supported");

    const exr_attr_box2i_t *window = &reader->window;
    const int64_t width = (int64_t)window->max.x - window->min.x + 1;
    const int64_t height = (int64_t)window->max.y - window->min.y + 1;
    const int count = channels->num_channels;
    if (width < 1 || width > IMAGE_MAX_SIDE || height < 1 || height > IMAGE_MAX_SIDE ||
        width * height > IMAGE_MAX_TEXELS)
        return fault(reader, "the size is out of range");
    if (count < 1 || count > IMAGE_MAX_PLANES || width * height > IMAGE_MAX_SAMPLES / count)
        return fault(reader, "the number of channels is out of range");
    image_init(reader->image, (uint32_t)width, (uint32_t)height);
    *list = channels;
    return EXR_ERR_SUCCESS;
}

static exr_result_t prepare(struct reader *reader)
{
    const exr_attr_chlist_t *channels;
    const exr_result_t result = read_size(reader, &channels);
    return result == EXR_ERR_SUCCESS ? add_planes(reader, channels) : result;
}

/* Both channels and planes have the order of the file's list. */
static void set_channels(exr_decode_pipeline_t *pipeline, const struct image *image, size_t first)
{
    for (int c = 0; c < pipeline->channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[c];
        channel->decode_to_ptr = (uint8_t *)(image->planes[c].texels + first);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = (int32_t)(image->width * sizeof(float));
    }
}

/* Each chunk has a pipeline of its own, because a reused one keeps stale pointers and buffers. */
static exr_result_t read_chunk(const struct reader *reader, const exr_chunk_info_t *chunk, size_t x,
                               size_t y)
{
    const struct image *image = reader->image;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t result;

    if (chunk->width < 1 || x + (size_t)chunk->width > image->width || chunk->height < 1 ||
        y + (size_t)chunk->height > image->height)
        return EXR_ERR_CORRUPT_CHUNK;
    if (chunk->compression == EXR_COMPRESSION_NONE && chunk->packed_size != chunk->unpacked_size)
        return EXR_ERR_CORRUPT_CHUNK;
    result = exr_decoding_initialize(reader->context, 0, chunk, &pipeline);
    if (result == EXR_ERR_SUCCESS) {
        set_channels(&pipeline, image, y * image->width + x);
        result = exr_decoding_choose_default_routines(reader->context, 0, &pipeline);
    }
    if (result == EXR_ERR_SUCCESS)
        result = exr_decoding_run(reader->context, 0, &pipeline);
    exr_decoding_destroy(reader->context, &pipeline);
    return result;
}

/* The library gives 0 where the header of a picture of scan lines has the attribute `tiles`. */
static exr_result_t get_lines(const struct reader *reader, int32_t *lines)
{
    const exr_result_t result = exr_get_scanlines_per_chunk(reader->context, 0, lines);
    return result == EXR_ERR_SUCCESS && *lines < 1 ? EXR_ERR_INVALID_ATTR : result;
}

static exr_result_t read_lines(const struct reader *reader)
{
    int32_t lines;
    exr_result_t result = get_lines(reader, &lines);

    for (uint32_t y = 0; y < reader->image->height && result == EXR_ERR_SUCCESS;
         y += (uint32_t)lines) {
        exr_chunk_info_t chunk;
        result =
            exr_read_scanline_chunk_info(reader->context, 0, reader->window.min.y + (int)y, &chunk);
        if (result == EXR_ERR_SUCCESS)
            result = read_chunk(reader, &chunk, 0, y);
    }
    return result;
}

static exr_result_t read_tiles(const struct reader *reader)
{
    const struct image *image = reader->image;
    int32_t width, height;
    exr_result_t result = exr_get_tile_sizes(reader->context, 0, 0, 0, &width, &height);

    if (result == EXR_ERR_SUCCESS && (width < 1 || height < 1))
        result = EXR_ERR_INVALID_ATTR;
    if (result != EXR_ERR_SUCCESS)
        return result;
    const uint32_t columns = (image->width - 1) / (uint32_t)width + 1;
    const uint32_t rows = (image->height - 1) / (uint32_t)height + 1;
    for (uint32_t i = 0; i < columns * rows && result == EXR_ERR_SUCCESS; i++) {
        const uint32_t column = i % columns, row = i / columns;
        exr_chunk_info_t chunk;
        result = exr_read_tile_chunk_info(reader->context, 0, (int)column, (int)row, 0, 0, &chunk);
        if (result == EXR_ERR_SUCCESS)
            result = read_chunk(reader, &chunk, (size_t)column * (uint32_t)width,
                                (size_t)row * (uint32_t)height);
    }
    return result;
}

static exr_result_t read_part(struct reader *reader)
{
    const exr_result_t result = prepare(reader);

    if (result != EXR_ERR_SUCCESS)
        return result;
    return reader->storage == EXR_STORAGE_TILED ? read_tiles(reader) : read_lines(reader);
}

/* Logs the error, if any, and returns its status. */
static enum status report(const char *path, const struct source *source, exr_result_t result)
{
    if (result == EXR_ERR_SUCCESS)
        return STATUS_OK;
    if (ferror(source->file)) {
        log_error("%s: reading failed", path);
        return STATUS_NO_INPUT;
    }
    if (source->out_of_memory)
        return log_out_of_memory(path);
    log_error("%s: %s", path,
              source->message[0] ? source->message : exr_get_default_error_message(result));
    return STATUS_DATA;
}

static exr_result_t open_reader(struct reader *reader, const char *path)
{
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;

    start.error_handler_fn = keep_message;
    start.alloc_fn = allocate;
    start.user_data = reader->source;
    start.read_fn = source_read;
    start.size_fn = source_size;
    start.max_image_width = IMAGE_MAX_SIDE;
    start.max_image_height = IMAGE_MAX_SIDE;
    start.max_tile_width = IMAGE_MAX_SIDE;
    start.max_tile_height = IMAGE_MAX_SIDE;
    /* A file with missing chunks is refused below, so the library need not search for them. */
    start.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    return exr_start_read(&reader->context, path, &start);
}

enum status exr_read(const char *path, struct image *image)
{
    struct source source = { 0 };
    struct reader reader = { .image = image, .source = &source };
    enum status status = file_open(path, &source.file, &source.size);
    exr_result_t result;

    if (status != STATUS_OK)
        return status;
    result = open_reader(&reader, path);
    if (result == EXR_ERR_SUCCESS)
        result = read_part(&reader);
    exr_finish(&reader.context);
    status = report(path, &source, result);
    if (status != STATUS_OK)
        image_finish(image);
    fclose(source.file);
    return status;
}

static bool has_texts(exr_const_context_t context, const struct exr_header *header)
{
    for (uint32_t i = 0; i < header->text_count; i++) {
        const struct image_text *text = &header->texts[i];
        const char *value;
        int32_t length;
        if (exr_attr_get_string(context, 0, text->name, &length, &value) != EXR_ERR_SUCCESS ||
            (size_t)length != strlen(text->value) ||
            memcmp(value, text->value, (size_t)length) != 0)
            return false;
    }
    return true;
}

static bool has_plane(const struct image *image, const struct image_plane *wanted)
{
    for (uint32_t i = 0; i < image->plane_count; i++) {
        const struct image_plane *plane = &image->planes[i];
        if (strcmp(plane->name, wanted->name) == 0)
            return plane->half == wanted->half;
    }
    return false;
}

static bool has_form(const struct image *image, const struct image *wanted)
{
    bool same = image->width == wanted->width && image->height == wanted->height &&
                image->plane_count == wanted->plane_count;
    for (uint32_t i = 0; i < wanted->plane_count && same; i++)
        same = has_plane(image, &wanted->planes[i]);
    return same;
}

static bool find_place(const struct reader *reader, struct exr_place *place)
{
    const exr_attr_box2i_t *data = &reader->window;
    exr_attr_box2i_t display;
    if (exr_get_display_window(reader->context, 0, &display) != EXR_ERR_SUCCESS ||
        data->min.x < display.min.x || data->min.y < display.min.y || data->max.x > display.max.x ||
        data->max.y > display.max.y)
        return false;
    *place = (struct exr_place){
        .x = (uint32_t)data->min.x - (uint32_t)display.min.x,
        .y = (uint32_t)data->min.y - (uint32_t)display.min.y,
        .width = (uint32_t)display.max.x - (uint32_t)display.min.x + 1,
        .height = (uint32_t)display.max.y - (uint32_t)display.min.y + 1,
    };
    return true;
}

static bool has_place(const struct reader *reader, const struct exr_place *wanted)
{
    struct exr_place place;
    if (!find_place(reader, &place))
        return false;
    if (!wanted->width)
        return place.width == reader->image->width && place.height == reader->image->height;
    return place.x == wanted->x && place.y == wanted->y && place.width == wanted->width &&
           place.height == wanted->height;
}

bool exr_matches(const char *path, const struct image *image, const struct exr_header *header)
{
    struct source source = { 0 };
    struct image found = { 0 };
    struct reader reader = { .image = &found, .source = &source };
    bool same;

    if (file_open(path, &source.file, &source.size) != STATUS_OK)
        return false;
    same = open_reader(&reader, path) == EXR_ERR_SUCCESS && has_texts(reader.context, header) &&
           read_part(&reader) == EXR_ERR_SUCCESS && has_form(&found, image) &&
           has_place(&reader, &header->place);
    exr_finish(&reader.context);
    image_finish(&found);
    fclose(source.file);
    return same;
}

enum status exr_inspect(const char *path, const char *name, char **text)
{
    struct source source = { 0 };
    struct image image = { 0 };
    struct reader reader = { .image = &image, .source = &source };
    const char *value = NULL;
    int32_t length;
    exr_result_t result;
    enum status status = file_open(path, &source.file, &source.size);

    *text = NULL;
    if (status != STATUS_OK)
        return status;
    result = open_reader(&reader, path);
    if (result == EXR_ERR_SUCCESS)
        result = read_part(&reader);
    if (result == EXR_ERR_SUCCESS &&
        exr_attr_get_string(reader.context, 0, name, &length, &value) != EXR_ERR_SUCCESS)
        value = "";
    status = report(path, &source, result);
    if (status == STATUS_OK && !(*text = strdup(value)))
        status = log_out_of_memory(path);
    exr_finish(&reader.context);
    image_finish(&image);
    fclose(source.file);
    return status;
}

/* ---- some rows at a time ---- */

struct exr_file {
    struct source source;
    struct reader reader;
    struct image rows; /* the rows of one chunk */
    uint32_t height;   /* of the picture */
    uint32_t first;    /* row of the picture with which `rows` begin */
    bool is_read;      /* `rows` are filled */
    char *path;
};

static exr_result_t open_rows(struct exr_file *file)
{
    struct reader *reader = &file->reader;
    const exr_attr_chlist_t *channels;
    int32_t lines;
    exr_result_t result = open_reader(reader, file->path);

    if (result == EXR_ERR_SUCCESS)
        result = read_size(reader, &channels);
    if (result == EXR_ERR_SUCCESS && reader->storage != EXR_STORAGE_SCANLINE)
        result = fault(reader, "expected scan lines");
    if (result == EXR_ERR_SUCCESS)
        result = get_lines(reader, &lines);
    if (result != EXR_ERR_SUCCESS)
        return result;
    file->height = file->rows.height;
    file->rows.height = (uint32_t)lines;
    return add_planes(reader, channels);
}

enum status exr_open(struct exr_file **opened, const char *path, struct image *image)
{
    struct exr_file *file = calloc(1, sizeof(*file));
    enum status status;

    *opened = NULL;
    if (file)
        file->path = strdup(path);
    if (!file || !file->path) {
        free(file);
        return log_out_of_memory(path);
    }
    file->reader = (struct reader){ .image = &file->rows, .source = &file->source };
    status = file_open(path, &file->source.file, &file->source.size);
    if (status == STATUS_OK)
        status = report(path, &file->source, open_rows(file));
    if (status != STATUS_OK) {
        exr_close(file);
        return status;
    }
    *image = file->rows;
    image->height = file->height;
    *opened = file;
    return STATUS_OK;
}

void exr_close(struct exr_file *file)
{
    if (!file)
        return;
    if (file->reader.context)
        exr_finish(&file->reader.context);
    image_finish(&file->rows);
    if (file->source.file)
        fclose(file->source.file);
    free(file->path);
    free(file);
}

const char *exr_text(const struct exr_file *file, const char *name)
{
    const char *value;
    int32_t length;
    return exr_attr_get_string(file->reader.context, 0, name, &length, &value) == EXR_ERR_SUCCESS
               ? value
               : NULL;
}

bool exr_find_place(const struct exr_file *file, struct exr_place *place)
{
    return find_place(&file->reader, place);
}

bool exr_matrix(const struct exr_file *file, const char *name, float *matrix)
{
    exr_attr_m44f_t value;
    if (exr_attr_get_m44f(file->reader.context, 0, name, &value) != EXR_ERR_SUCCESS)
        return false;
    memcpy(matrix, value.m, sizeof(value.m));
    return true;
}

const float *exr_row(struct exr_file *file, uint32_t plane, uint32_t y)
{
    const struct reader *reader = &file->reader;
    const uint32_t lines = file->rows.height;
    const uint32_t first = y / lines * lines;
    exr_chunk_info_t chunk;

    if (!file->is_read || file->first != first) {
        exr_result_t result = exr_read_scanline_chunk_info(
            reader->context, 0, reader->window.min.y + (int)first, &chunk);
        if (result == EXR_ERR_SUCCESS)
            result = read_chunk(reader, &chunk, 0, 0);
        file->is_read = report(file->path, &file->source, result) == STATUS_OK;
        file->first = first;
    }
    return file->is_read ? file->rows.planes[plane].texels + (size_t)(y - first) * file->rows.width
                         : NULL;
}
