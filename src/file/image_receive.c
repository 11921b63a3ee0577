/* image_receive.c: receives an image's header and rows from a reader process. */
#include "src/file/image_receive.h"
#include <stdlib.h>
#include <string.h>

struct image_reader {
    struct reader *reader; /* NULL once it has ended */
    struct pipe_source source;
    uint32_t width, height, plane_count;
    uint32_t next; /* index of the next row */
    float *row;    /* row next - 1, all planes */
};

static enum status begin(struct reader **reader, struct image_header *head, const char *path,
                         const struct reader_params *params, enum reader_kind kind)
{
    *head = (struct image_header){ 0 };
    const enum status status = reader_start(reader, params, kind, path);
    if (status != STATUS_OK)
        return status;
    const struct pipe_source source = reader_source(*reader);
    const enum pipe_fault fault = image_pipe_read_header(&source, head);
    if (fault == PIPE_OK)
        return STATUS_OK;
    struct reader *failed = *reader;
    *reader = NULL;
    return reader_end(failed, fault);
}

enum status image_reader_open(struct image_reader **opened, const char *path,
                              const struct reader_params *params, struct image_header *head)
{
    struct reader *reader;
    enum status status = begin(&reader, head, path, params, READER_IMAGE);
    *opened = NULL;
    if (status != STATUS_OK)
        return status;
    struct image_reader *image_reader = calloc(1, sizeof(*image_reader));
    const struct image *image = &head->image;
    float *row = malloc((size_t)image->width * image->plane_count * sizeof(*row));
    if (!image_reader || !row) {
        free(image_reader);
        free(row);
        image_header_finish(head);
        return reader_end(reader, PIPE_MEMORY);
    }
    *image_reader = (struct image_reader){
        .reader = reader,
        .source = reader_source(reader),
        .width = image->width,
        .height = image->height,
        .plane_count = image->plane_count,
        .row = row,
    };
    *opened = image_reader;
    return STATUS_OK;
}

static enum status read_row(struct image_reader *image_reader)
{
    const size_t size =
        (size_t)image_reader->width * image_reader->plane_count * sizeof(*image_reader->row);
    enum pipe_fault fault = pipe_read(&image_reader->source, image_reader->row, size);
    image_reader->next++;
    if (fault == PIPE_OK && image_reader->next == image_reader->height)
        fault = pipe_read_end(&image_reader->source);
    else if (fault == PIPE_OK)
        return STATUS_OK;
    struct reader *reader = image_reader->reader;
    image_reader->reader = NULL;
    return reader_end(reader, fault);
}

enum status image_reader_row(struct image_reader *image_reader, uint32_t plane, uint32_t y,
                             const float **row)
{
    enum status status = STATUS_OK;
    while (image_reader->next <= y && status == STATUS_OK)
        status = read_row(image_reader);
    *row = image_reader->row + (size_t)plane * image_reader->width;
    return status;
}

void image_reader_close(struct image_reader *image_reader)
{
    if (!image_reader)
        return;
    reader_drop(image_reader->reader);
    free(image_reader->row);
    free(image_reader);
}

/* Reads all rows into an image whose planes are allocated. */
static enum pipe_fault read_texels(const struct pipe_source *source, struct image *image)
{
    enum pipe_fault fault = PIPE_OK;
    for (uint32_t y = 0; y < image->height && fault == PIPE_OK; y++) {
        for (uint32_t p = 0; p < image->plane_count && fault == PIPE_OK; p++)
            fault = pipe_read(source, image->planes[p].texels + (size_t)y * image->width,
                              image->width * sizeof(float));
    }
    return fault == PIPE_OK ? pipe_read_end(source) : fault;
}

enum status image_reader_read(struct image *image, const char *path,
                              const struct reader_params *params)
{
    struct reader *reader;
    struct image_header head;
    enum status status = begin(&reader, &head, path, params, READER_IMAGE);
    if (status != STATUS_OK)
        return status;
    const struct pipe_source source = reader_source(reader);
    const struct image *found = &head.image;
    const uint64_t plane_size = (uint64_t)found->width * found->height * sizeof(float);
    enum pipe_fault fault = PIPE_LARGE;
    if (plane_size * found->plane_count <= source.size_max / 4)
        fault = image_init_like(image, found, found->height) ? PIPE_OK : PIPE_MEMORY;
    if (fault == PIPE_OK)
        fault = read_texels(&source, image);
    status = reader_end(reader, fault);
    if (status != STATUS_OK)
        image_finish(image);
    image_header_finish(&head);
    return status;
}

enum status image_reader_check(struct image_header *head, const char *path,
                               const struct reader_params *params)
{
    struct reader *reader;
    enum status status = begin(&reader, head, path, params, READER_IMAGE_CHECK);
    if (status != STATUS_OK)
        return status;
    const struct pipe_source source = reader_source(reader);
    status = reader_end(reader, pipe_read_end(&source));
    if (status != STATUS_OK)
        image_header_finish(head);
    return status;
}
