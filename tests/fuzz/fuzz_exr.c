/*
 * fuzz_exr.c: reads the input as an EXR file: as a whole, to its end, by rows, through a reader
 * process, and as a panorama. Whatever it is, all of them agree: they accept it with the same
 * texels, or they refuse it.
 */
#define _GNU_SOURCE /* memmem() */
#include <stdlib.h>
#include <string.h>
#include "src/file/exr.h"
#include "src/file/image_receive.h"
#include "tests/fuzz/fuzz_file.h"
#include "tests/fuzz/fuzz_image.h"
#include "tests/fuzz/fuzz_scene.h"

enum {
    TEXELS_MAX = 1 << 18
};

/* Whether the header has a window of more texels than are read here, but not more than the reader
 * accepts. Large pictures cost time and show nothing else. `key` begins the window's attribute. */
static bool is_large(const uint8_t *data, size_t size, const char *key, size_t key_size)
{
    const uint8_t *found = memmem(data, size, key, key_size);
    int32_t window[4];
    if (!found || (size_t)(data + size - found) < key_size + sizeof(window))
        return false;
    memcpy(window, found + key_size, sizeof(window));
    const int64_t width = (int64_t)window[2] - window[0] + 1;
    const int64_t height = (int64_t)window[3] - window[1] + 1;
    return width > 0 && width <= IMAGE_MAX_SIDE && height > 0 && height <= IMAGE_MAX_SIDE &&
           width * height > TEXELS_MAX && width * height <= IMAGE_MAX_TEXELS;
}

struct stream {
    uint8_t *bytes;
    size_t size, at;
};

static bool write_stream(void *user, const void *bytes, size_t size)
{
    struct stream *stream = user;
    stream->bytes = realloc(stream->bytes, stream->size + size);
    FUZZ_CHECK(stream->bytes != NULL);
    memcpy(stream->bytes + stream->size, bytes, size);
    stream->size += size;
    return true;
}

static bool read_stream(void *user, void *bytes, size_t size)
{
    struct stream *stream = user;
    if (size > stream->size - stream->at)
        return false;
    memcpy(bytes, stream->bytes + stream->at, size);
    stream->at += size;
    return true;
}

static void check_rows(const struct stream *stream, const struct image *whole)
{
    const uint8_t *row = stream->bytes + stream->at;
    const size_t size = whole->width * sizeof(float);
    for (uint32_t y = 0; y < whole->height; y++) {
        for (uint32_t p = 0; p < whole->plane_count; p++, row += size)
            FUZZ_CHECK(!memcmp(row, whole->planes[p].texels + (size_t)y * whole->width, size));
    }
    FUZZ_CHECK(row + sizeof(uint32_t) == stream->bytes + stream->size); /* the end */
}

/* What a reader process sends of a file whose texels are in `whole`, or {0} if it was refused. */
static void send(const char *path, const struct image *whole)
{
    struct stream stream = { 0 };
    struct image_header head;
    const enum status status = image_send(path, &(struct pipe_sink){ write_stream, &stream });
    FUZZ_CHECK((status == STATUS_OK) == (whole->planes != NULL));
    const struct pipe_source source = { read_stream, &stream, TEXELS_MAX };
    const enum pipe_fault fault = image_pipe_read_header(&source, &head);
    FUZZ_CHECK(fault == PIPE_OK || (fault == PIPE_SHORT && status != STATUS_OK));
    if (status == STATUS_OK) {
        FUZZ_CHECK(image_header_matches(&head, whole, NULL, 0));
        check_rows(&stream, whole);
    }
    image_header_finish(&head);
    free(stream.bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char data_window[] = "dataWindow\0box2i\0\x10\0\0";
    static const char display_window[] = "displayWindow\0box2i\0\x10\0\0";
    char path[FUZZ_PATH_SIZE];
    struct image image = { 0 };
    struct image_header head;
    if (is_large(data, size, data_window, sizeof(data_window)) ||
        is_large(data, size, display_window, sizeof(display_window)))
        return 0;
    fuzz_file_write(path, "a.exr", data, size);
    const enum status status = exr_read(path, &image, &head);
    image_header_finish(&head);
    fuzz_check_image(&image, status);
    FUZZ_CHECK(exr_check(path, &head) == status);
    FUZZ_CHECK((head.image.planes != NULL) == (status == STATUS_OK));
    FUZZ_CHECK(!head.has_window || head.window.x < head.window.width);
    image_header_finish(&head);
    send(path, &image);
    FUZZ_CHECK(fuzz_load_environment(path) != STATUS_OK || status == STATUS_OK);
    image_finish(&image);
    return 0;
}
