/* exr_read.c: reads one part of an OpenEXR file as float planes, one row of chunks at a time. */
#include <OpenEXR/openexr.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/file/exr.h"

struct source {
    FILE *file;
    int64_t size;
    char message[256];  /* first message of the OpenEXR library */
    bool out_of_memory; /* for planes; not for damaged chunks */
};

struct exr_file {
    struct source source;
    char *path;
    exr_context_t context;
    int part;
    exr_storage_t storage;
    exr_attr_box2i_t window; /* data window: the image */
    uint32_t height;         /* of the image */
    int32_t chunk_width;     /* tile width, else image width */
    struct image rows;       /* decoded row of chunks */
    uint32_t first;          /* first image row in `rows` */
    bool is_read;            /* `rows` is filled */
};

static int64_t source_read(exr_const_context_t context, void *user, void *bytes, uint64_t size,
                           uint64_t offset, exr_stream_error_func_ptr_t report)
{
    struct source *source = user;

    (void)context;
    (void)report;
    if (offset > (uint64_t)source->size || !file_seek(source->file, (int64_t)offset))
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

/* Allocates zeroed memory. The OpenEXR library leaves memory unwritten if chunks are too short. */
static void *allocate(size_t size)
{
    return calloc(1, size);
}

static exr_result_t fault(struct exr_file *file, const char *text)
{
    snprintf(file->source.message, sizeof(file->source.message), "%s", text);
    return EXR_ERR_FILE_BAD_HEADER;
}

static bool has_channel(const exr_attr_chlist_t *channels, const char *name)
{
    for (int c = 0; c < channels->num_channels; c++) {
        if (strcmp(channels->entries[c].name.str, name) == 0)
            return true;
    }
    return false;
}

/* Returns true if a layer "name.R", "name.G", "name.B" is complete. */
static bool has_layer(const exr_attr_chlist_t *channels)
{
    char name[IMAGE_NAME_SIZE];
    for (int c = 0; c < channels->num_channels && channels->num_channels <= IMAGE_MAX_PLANES; c++) {
        const size_t length = strlen(channels->entries[c].name.str);
        if (length < 2 || length >= sizeof(name))
            continue;
        memcpy(name, channels->entries[c].name.str, length + 1);
        if (strcmp(name + length - 2, ".R") != 0)
            continue;
        name[length - 1] = 'G';
        const bool has_green = has_channel(channels, name);
        name[length - 1] = 'B';
        if (has_green && has_channel(channels, name))
            return true;
    }
    return false;
}

static bool is_flat(const struct exr_file *file, int part, exr_storage_t *storage)
{
    return exr_get_storage(file->context, part, storage) == EXR_ERR_SUCCESS &&
           (*storage == EXR_STORAGE_SCANLINE || *storage == EXR_STORAGE_TILED);
}

/* Selects the first part with channels R, G and B or, if there is none, the first with a layer that
 * has these or, if there is none, the first non-deep part. */
static exr_result_t choose_part(struct exr_file *file)
{
    int count = 0, chosen = -1;
    bool is_layered = false;
    exr_storage_t storage;
    exr_result_t result = exr_get_count(file->context, &count);
    for (int part = 0; part < count && result == EXR_ERR_SUCCESS; part++) {
        const exr_attr_chlist_t *channels;
        if (!is_flat(file, part, &storage))
            continue;
        if (chosen < 0)
            chosen = part;
        result = exr_get_channels(file->context, part, &channels);
        if (result == EXR_ERR_SUCCESS && has_channel(channels, "R") && has_channel(channels, "G") &&
            has_channel(channels, "B")) {
            chosen = part;
            break;
        }
        if (result == EXR_ERR_SUCCESS && !is_layered && has_layer(channels)) {
            chosen = part;
            is_layered = true;
        }
    }
    if (result != EXR_ERR_SUCCESS)
        return result;
    if (chosen < 0)
        return fault(file, "deep images are not supported");
    if (count > 1)
        log_warning("%s: only part %d of the file's %d parts is read", file->path, chosen + 1,
                    count);
    file->part = chosen;
    return exr_get_storage(file->context, chosen, &file->storage);
}

/* Validates image size and channel count before memory is allocated for them. */
static exr_result_t read_size(struct exr_file *file, const exr_attr_chlist_t **list)
{
    exr_result_t result = exr_get_data_window(file->context, file->part, &file->window);
    if (result == EXR_ERR_SUCCESS)
        result = exr_get_channels(file->context, file->part, list);
    if (result != EXR_ERR_SUCCESS)
        return result;
    const exr_attr_box2i_t *window = &file->window;
    const int64_t width = (int64_t)window->max.x - window->min.x + 1;
    const int64_t height = (int64_t)window->max.y - window->min.y + 1;
    const int count = (*list)->num_channels;
    if (width < 1 || width > IMAGE_MAX_SIDE || height < 1 || height > IMAGE_MAX_SIDE ||
        width * height > IMAGE_MAX_TEXELS)
        return fault(file, "the size is out of range");
    if (count < 1 || count > IMAGE_MAX_PLANES || width * height > IMAGE_MAX_SAMPLES / count)
        return fault(file, "the number of channels is out of range");
    image_init(&file->rows, (uint32_t)width, (uint32_t)height);
    return EXR_ERR_SUCCESS;
}

/* Reads the size of a chunk, which is a tile or a group of scan lines compressed together. Rejects
 * scan line files with an attribute `tiles`, because OpenEXR reports 0 lines per chunk for them. */
static exr_result_t read_chunk_size(struct exr_file *file)
{
    int32_t height;
    exr_result_t result;
    file->height = file->rows.height;
    file->chunk_width = (int32_t)file->rows.width;
    if (file->storage == EXR_STORAGE_TILED)
        result = exr_get_tile_sizes(file->context, file->part, 0, 0, &file->chunk_width, &height);
    else
        result = exr_get_scanlines_per_chunk(file->context, file->part, &height);
    if (result != EXR_ERR_SUCCESS)
        return result;
    if (file->chunk_width < 1 || height < 1)
        return EXR_ERR_INVALID_ATTR;
    if ((uint32_t)height < file->height)
        file->rows.height = (uint32_t)height;
    return EXR_ERR_SUCCESS;
}

static exr_result_t add_planes(struct exr_file *file, const exr_attr_chlist_t *channels)
{
    for (int c = 0; c < channels->num_channels; c++) {
        const exr_attr_chlist_entry_t *channel = &channels->entries[c];
        if (channel->x_sampling != 1 || channel->y_sampling != 1)
            return fault(file, "subsampled channels (luminance and chroma: Y, RY, BY) are not "
                               "supported: export R, G and B");
        if (strlen(channel->name.str) >= IMAGE_NAME_SIZE)
            return fault(file, "a channel's name is too long");
        if (image_find(&file->rows, channel->name.str))
            return fault(file, "two channels have the same name");
        if (!image_add_plane(&file->rows, channel->name.str,
                             channel->pixel_type == EXR_PIXEL_HALF)) {
            file->source.out_of_memory = true;
            return EXR_ERR_OUT_OF_MEMORY;
        }
        file->rows.planes[c].integer = channel->pixel_type == EXR_PIXEL_UINT;
    }
    return EXR_ERR_SUCCESS;
}

static bool find_window(const struct exr_file *file, struct image_window *window)
{
    const exr_attr_box2i_t *data = &file->window;
    exr_attr_box2i_t display;
    if (exr_get_display_window(file->context, file->part, &display) != EXR_ERR_SUCCESS ||
        data->min.x < display.min.x || data->min.y < display.min.y || data->max.x > display.max.x ||
        data->max.y > display.max.y)
        return false;
    *window = (struct image_window){
        .x = (uint32_t)data->min.x - (uint32_t)display.min.x,
        .y = (uint32_t)data->min.y - (uint32_t)display.min.y,
        .width = (uint32_t)display.max.x - (uint32_t)display.min.x + 1,
        .height = (uint32_t)display.max.y - (uint32_t)display.min.y + 1,
    };
    return true;
}

static struct image_box box_of(const exr_attr_box2i_t *window)
{
    const int64_t width = (int64_t)window->max.x - window->min.x + 1;
    const int64_t height = (int64_t)window->max.y - window->min.y + 1;
    if (width < 1 || height < 1)
        return (struct image_box){ 0 };
    return (struct image_box){
        .x = window->min.x,
        .y = window->min.y,
        .width = width < UINT32_MAX ? (uint32_t)width : UINT32_MAX,
        .height = height < UINT32_MAX ? (uint32_t)height : UINT32_MAX,
    };
}

static void find_boxes(const struct exr_file *file, struct image_header *head)
{
    exr_attr_box2i_t display;
    head->data_window = box_of(&file->window);
    if (exr_get_display_window(file->context, file->part, &display) == EXR_ERR_SUCCESS)
        head->display_window = box_of(&display);
}

static bool find_matrix(const struct exr_file *file, const char *name, float matrix[static 16])
{
    exr_attr_m44f_t value;
    if (exr_attr_get_m44f(file->context, file->part, name, &value) != EXR_ERR_SUCCESS)
        return false;
    memcpy(matrix, value.m, sizeof(value.m));
    return true;
}

static bool find_primaries(const struct exr_file *file, struct primaries *primaries)
{
    exr_attr_chromaticities_t value;
    if (exr_attr_get_chromaticities(file->context, file->part, "chromaticities", &value) !=
        EXR_ERR_SUCCESS)
        return false;
    *primaries = (struct primaries){
        .red = { value.red_x, value.red_y },
        .green = { value.green_x, value.green_y },
        .blue = { value.blue_x, value.blue_y },
        .white = { value.white_x, value.white_y },
    };
    return true;
}

static bool add_texts(const struct exr_file *file, struct image_header *head)
{
    int32_t count = 0;
    bool done = true;
    if (exr_get_attribute_count(file->context, file->part, &count) != EXR_ERR_SUCCESS)
        return true;
    for (int32_t i = 0; i < count && done; i++) {
        const exr_attribute_t *a;
        if (exr_get_attribute_by_index(file->context, file->part, EXR_ATTR_LIST_FILE_ORDER, i,
                                       &a) == EXR_ERR_SUCCESS &&
            a->type == EXR_ATTR_STRING && a->string->length >= 0)
            done = image_header_add_text(head, a->name, a->string->str, (size_t)a->string->length);
    }
    return done;
}

static bool fill_head(const struct exr_file *file, struct image_header *head)
{
    bool done = true;
    image_init(&head->image, file->rows.width, file->height);
    for (uint32_t p = 0; p < file->rows.plane_count && done; p++) {
        const struct image_plane *plane = &file->rows.planes[p];
        done = image_header_add_plane(head, plane->name, plane->half);
        if (done)
            head->image.planes[p].integer = plane->integer;
    }
    head->has_window = find_window(file, &head->window);
    find_boxes(file, head);
    head->has_world_to_camera = find_matrix(file, "worldToCamera", head->world_to_camera);
    head->has_world_to_ndc = find_matrix(file, "worldToNDC", head->world_to_ndc);
    head->has_primaries = find_primaries(file, &head->primaries);
    exr_envmap_t envmap;
    if (exr_attr_get_envmap(file->context, file->part, "envmap", &envmap) == EXR_ERR_SUCCESS) {
        head->is_cube_map = envmap == EXR_ENVMAP_CUBE;
        head->is_latlong = envmap == EXR_ENVMAP_LATLONG;
    }
    return done && add_texts(file, head);
}

/* Makes the decoder write into the planes of an image, from texel `first` on. */
static void set_channels(exr_decode_pipeline_t *pipeline, const struct image *rows, size_t first)
{
    for (int c = 0; c < pipeline->channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[c];
        channel->decode_to_ptr = (uint8_t *)(rows->planes[c].texels + first);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = (int32_t)(rows->width * sizeof(float));
    }
}

/* Decodes a chunk with a new pipeline, because a reused one has stale pointers and buffers. */
static exr_result_t read_chunk(const struct exr_file *file, const exr_chunk_info_t *chunk, size_t x)
{
    const struct image *rows = &file->rows;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t result;

    if (chunk->width < 1 || x + (size_t)chunk->width > rows->width || chunk->height < 1 ||
        (uint32_t)chunk->height > rows->height)
        return EXR_ERR_CORRUPT_CHUNK;
    if (chunk->compression == EXR_COMPRESSION_NONE && chunk->packed_size != chunk->unpacked_size)
        return EXR_ERR_CORRUPT_CHUNK;
    result = exr_decoding_initialize(file->context, file->part, chunk, &pipeline);
    if (result == EXR_ERR_SUCCESS) {
        set_channels(&pipeline, rows, x);
        result = exr_decoding_choose_default_routines(file->context, file->part, &pipeline);
    }
    if (result == EXR_ERR_SUCCESS)
        result = exr_decoding_run(file->context, file->part, &pipeline);
    exr_decoding_destroy(file->context, &pipeline);
    return result;
}

static exr_result_t find_chunk(const struct exr_file *file, uint32_t column, uint32_t first,
                               exr_chunk_info_t *chunk)
{
    if (file->storage == EXR_STORAGE_TILED)
        return exr_read_tile_chunk_info(file->context, file->part, (int)column,
                                        (int)(first / file->rows.height), 0, 0, chunk);
    return exr_read_scanline_chunk_info(file->context, file->part, file->window.min.y + (int)first,
                                        chunk);
}

/* Decodes the row of chunks that begins at image row `first`. */
static exr_result_t read_rows(const struct exr_file *file, uint32_t first)
{
    const size_t chunk_width = (size_t)file->chunk_width;
    exr_result_t result = EXR_ERR_SUCCESS;
    uint32_t column = 0;
    for (size_t x = 0; x < file->rows.width && result == EXR_ERR_SUCCESS; x += chunk_width) {
        exr_chunk_info_t chunk;
        result = find_chunk(file, column++, first, &chunk);
        if (result == EXR_ERR_SUCCESS)
            result = read_chunk(file, &chunk, x);
    }
    return result;
}

/* Logs an OpenEXR error, if there is one, and returns the matching status. */
static enum status report(const struct exr_file *file, exr_result_t result)
{
    const struct source *source = &file->source;
    const char *path = file->path;
    if (result == EXR_ERR_SUCCESS)
        return STATUS_OK;
    if (ferror(source->file)) {
        log_error("%s: cannot be read: %s", path, strerror(EIO));
        return STATUS_NO_INPUT;
    }
    if (source->out_of_memory)
        return log_out_of_memory(path);
    log_error("%s: %s", path,
              source->message[0] ? source->message : exr_get_default_error_message(result));
    return STATUS_DATA;
}

static exr_result_t open_context(struct exr_file *file)
{
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;

    start.error_handler_fn = keep_message;
    start.alloc_fn = allocate;
    start.user_data = &file->source;
    start.read_fn = source_read;
    start.size_fn = source_size;
    start.max_image_width = IMAGE_MAX_SIDE;
    start.max_image_height = IMAGE_MAX_SIDE;
    start.max_tile_width = IMAGE_MAX_SIDE;
    start.max_tile_height = IMAGE_MAX_SIDE;
    /* Rejects files with missing chunks instead of reconstructing the chunk table. */
    start.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    return exr_start_read(&file->context, file->path, &start);
}

static exr_result_t read_header(struct exr_file *file)
{
    const exr_attr_chlist_t *channels;
    exr_result_t result = open_context(file);
    if (result == EXR_ERR_SUCCESS)
        result = choose_part(file);
    if (result == EXR_ERR_SUCCESS)
        result = read_size(file, &channels);
    if (result == EXR_ERR_SUCCESS)
        result = read_chunk_size(file);
    return result == EXR_ERR_SUCCESS ? add_planes(file, channels) : result;
}

enum status exr_open(struct exr_file **opened, const char *path, struct image_header *head)
{
    struct exr_file *file = calloc(1, sizeof(*file));
    enum status status;

    *opened = NULL;
    *head = (struct image_header){ 0 };
    if (file)
        file->path = strdup(path);
    if (!file || !file->path) {
        free(file);
        return log_out_of_memory(path);
    }
    status = file_io_open(path, &file->source.file, &file->source.size);
    if (status == STATUS_OK)
        status = report(file, read_header(file));
    if (status == STATUS_OK && !fill_head(file, head))
        status = log_out_of_memory(path);
    if (status != STATUS_OK) {
        image_header_finish(head);
        exr_close(file);
        return status;
    }
    *opened = file;
    return STATUS_OK;
}

void exr_close(struct exr_file *file)
{
    if (!file)
        return;
    if (file->context)
        exr_finish(&file->context);
    image_finish(&file->rows);
    if (file->source.file)
        fclose(file->source.file);
    free(file->path);
    free(file);
}

enum status exr_row(struct exr_file *file, uint32_t plane, uint32_t y, const float **row)
{
    const uint32_t first = y / file->rows.height * file->rows.height;

    if (!file->is_read || file->first != first) {
        const enum status status = report(file, read_rows(file, first));
        file->is_read = status == STATUS_OK;
        file->first = first;
        if (status != STATUS_OK)
            return status;
    }
    *row = file->rows.planes[plane].texels + (size_t)(y - first) * file->rows.width;
    return STATUS_OK;
}

enum status exr_read(const char *path, struct image *image, struct image_header *head)
{
    struct exr_file *file;
    enum status status = exr_open(&file, path, head);
    if (status == STATUS_OK && !image_init_like(image, &head->image, head->image.height))
        status = log_out_of_memory(path);
    for (uint32_t y = 0; y < head->image.height && status == STATUS_OK; y++) {
        for (uint32_t p = 0; p < head->image.plane_count && status == STATUS_OK; p++) {
            const float *row;
            status = exr_row(file, p, y, &row);
            if (status == STATUS_OK)
                memcpy(image->planes[p].texels + (size_t)y * image->width, row,
                       image->width * sizeof(*row));
        }
    }
    if (status != STATUS_OK) {
        image_finish(image);
        image_header_finish(head);
    }
    exr_close(file);
    return status;
}

enum status exr_check(const char *path, struct image_header *head)
{
    struct exr_file *file;
    const float *row;
    enum status status = exr_open(&file, path, head);
    for (uint32_t y = 0; y < head->image.height && status == STATUS_OK; y++)
        status = exr_row(file, 0, y, &row);
    if (status != STATUS_OK)
        image_header_finish(head);
    exr_close(file);
    return status;
}

bool exr_matches(const struct image_header *head, const struct image *image,
                 const struct exr_header *header)
{
    const struct image_window *window = &head->window, *expected = &header->window;
    if (!head->has_window || !image_header_matches(head, image, header->texts, header->text_count))
        return false;
    if (!expected->width)
        return window->width == image->width && window->height == image->height;
    return window->x == expected->x && window->y == expected->y &&
           window->width == expected->width && window->height == expected->height;
}
