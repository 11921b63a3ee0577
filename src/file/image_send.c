/* image_send.c: decodes an image in the reader process and sends it to the parent. */
#include <stdlib.h>
#include "src/base/path.h"
#include "src/file/exr.h"
#include "src/file/hdr.h"
#include "src/file/image_receive.h"
#include "src/file/png.h"

/* Image formats that are decoded as a whole; EXR is decoded row by row. */
static const struct format {
    const char *end;
    enum status (*read)(const char *path, struct image *image, image_size_fn *begin, void *user);
    enum status (*check)(const char *path, struct image_header *head); /* NULL: decode by `read` */
} formats[] = {
    { ".hdr", hdr_read, NULL },
    { ".png", png_read, png_check },
};

enum {
    FORMAT_COUNT = sizeof(formats) / sizeof(formats[0])
};

/* Returns the format of a path according to its suffix; NULL for EXR files. */
static const struct format *find_format(const char *path)
{
    for (size_t i = 0; i < FORMAT_COUNT; i++) {
        if (path_ends_in(path, formats[i].end))
            return &formats[i];
    }
    return NULL;
}

bool image_reader_knows_suffix(const char *path)
{
    return path_ends_in(path, ".exr") || find_format(path);
}

static enum status send_exr(const char *path, const struct pipe_sink *sink)
{
    struct exr_file *file;
    struct image_header head;
    enum status status = exr_open(&file, path, &head);
    if (status == STATUS_OK && !image_pipe_write_header(sink, &head))
        status = STATUS_WRITE;
    for (uint32_t y = 0; y < head.image.height && status == STATUS_OK; y++) {
        for (uint32_t p = 0; p < head.image.plane_count && status == STATUS_OK; p++) {
            const float *row;
            status = exr_row(file, p, y, &row);
            if (status == STATUS_OK && !pipe_write(sink, row, head.image.width * sizeof(*row)))
                status = STATUS_WRITE;
        }
    }
    image_header_finish(&head);
    exr_close(file);
    return status;
}

static bool send_rows(const struct image *image, const struct pipe_sink *sink)
{
    bool done = true;
    for (uint32_t y = 0; y < image->height && done; y++) {
        for (uint32_t p = 0; p < image->plane_count && done; p++)
            done = pipe_write(sink, image->planes[p].texels + (size_t)y * image->width,
                              image->width * sizeof(float));
    }
    return done;
}

/* Sends a header before texels are decoded, so that the parent can reject the image early. */
static enum status send_size(void *user, uint32_t width, uint32_t height, uint32_t plane_count)
{
    struct image_plane planes[] = { { "R" }, { "G" }, { "B" }, { "A" } };
    const struct image_header head = { .image = { width, height, plane_count, planes } };
    return image_pipe_write_header(user, &head) ? STATUS_OK : STATUS_WRITE;
}

static enum status send_whole(const struct format *format, const char *path,
                              const struct pipe_sink *sink)
{
    struct image image = { 0 };
    struct pipe_sink copy = *sink; /* the callback's argument is not const */
    enum status status = format->read(path, &image, send_size, &copy);
    if (status == STATUS_OK && !send_rows(&image, sink))
        status = STATUS_WRITE;
    image_finish(&image);
    return status;
}

enum status image_send(const char *path, const struct pipe_sink *sink)
{
    const struct format *format = find_format(path);
    const enum status status = format ? send_whole(format, path, sink) : send_exr(path, sink);
    return status == STATUS_OK && !pipe_write_end(sink) ? STATUS_WRITE : status;
}

static enum status check(const char *path, struct image_header *head)
{
    const struct format *format = find_format(path);
    *head = (struct image_header){ 0 };
    if (!format)
        return exr_check(path, head);
    return format->check ? format->check(path, head) : format->read(path, &head->image, NULL, NULL);
}

enum status image_send_header(const char *path, const struct pipe_sink *sink)
{
    struct image_header head;
    enum status status = check(path, &head);
    if (status == STATUS_OK && !(image_pipe_write_header(sink, &head) && pipe_write_end(sink)))
        status = STATUS_WRITE;
    image_header_finish(&head);
    return status;
}
