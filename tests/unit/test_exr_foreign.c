/* test_exr_foreign.c: EXR files as other programs write them, made with the OpenEXR library. */
#include <OpenEXR/openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/file/exr.h"
#include "tests/support/assertions.h"

static char path[] = "/tmp/firn-test-exr-foreign-XXXXXX";

struct bytes {
    void *data;
    size_t size;
};

static enum status read_image(struct image *image)
{
    struct image_header head;
    const enum status status = exr_read(path, image, &head);
    image_header_finish(&head);
    return status;
}

static enum status read_bytes(const struct bytes *bytes, struct image *image)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes->data, 1, bytes->size, file), bytes->size);
    assert_int_equal(fclose(file), 0);
    return read_image(image);
}

static int64_t write_memory(exr_const_context_t context, void *user, const void *from,
                            uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t report)
{
    struct bytes *bytes = user;
    (void)context;
    (void)report;
    assert_true(offset + size <= 1 << 20); /* what start_write() provides */
    memcpy((char *)bytes->data + offset, from, size);
    if (bytes->size < offset + size)
        bytes->size = offset + size;
    return (int64_t)size;
}

static void start_write(exr_context_t *context, struct bytes *bytes)
{
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    *bytes = (struct bytes){ calloc(1, 1 << 20), 0 };
    start.user_data = bytes;
    start.write_fn = write_memory;
    assert_int_equal(exr_start_write(context, "memory", EXR_WRITE_FILE_DIRECTLY, &start), 0);
}

/* One chunk of which every channel's samples lie one after the other, from samples[c]. */
static void write_chunk(exr_context_t context, int part, const exr_chunk_info_t *chunk,
                        const void *const *samples, int channel_count)
{
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    assert_int_equal(exr_encoding_initialize(context, part, chunk, &pipeline), 0);
    assert_int_equal(pipeline.channel_count, channel_count);
    for (int c = 0; c < channel_count; c++) {
        exr_coding_channel_info_t *channel = &pipeline.channels[c];
        channel->user_pixel_stride = channel->data_type == EXR_PIXEL_HALF ? 2 : 4;
        channel->user_line_stride = channel->user_pixel_stride * channel->width;
        channel->encode_from_ptr = samples[c];
    }
    assert_int_equal(exr_encoding_choose_default_routines(context, part, &pipeline), 0);
    assert_int_equal(exr_encoding_run(context, part, &pipeline), 0);
    assert_int_equal(exr_encoding_destroy(context, &pipeline), 0);
}

enum {
    SMALL_WIDTH = 7,
    SMALL_HEIGHT = 5,
    SMALL_COUNT = SMALL_WIDTH * SMALL_HEIGHT
};

/* A float (F), a half (H) and a uint (U) channel, in one or several scan-line chunks. */
static struct bytes write_three_types(exr_compression_t compression, int32_t x, int32_t y)
{
    const exr_attr_box2i_t data = {
        .min.x = x,
        .min.y = y,
        .max.x = x + SMALL_WIDTH - 1,
        .max.y = y + SMALL_HEIGHT - 1,
    };
    const exr_attr_box2i_t display = { .min.x = -3, .max.x = 100, .max.y = 50 };
    const exr_attr_v2f_t centre = { .x = 0.0f };
    float floats[SMALL_COUNT];
    uint16_t halves[SMALL_COUNT];
    uint32_t integers[SMALL_COUNT];
    exr_context_t context = NULL;
    struct bytes bytes;
    int part;

    for (int i = 0; i < SMALL_COUNT; i++) {
        floats[i] = 0.25f * (float)i;
        halves[i] = (uint16_t)(0x3c00 + i); /* 1 + i / 1024 */
        integers[i] = (uint32_t)i * 1000;
    }
    start_write(&context, &bytes);
    assert_int_equal(exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part), 0);
    assert_int_equal(exr_initialize_required_attr(context, 0, &display, &data, 1.0f, &centre, 1.0f,
                                                  EXR_LINEORDER_INCREASING_Y, compression),
                     0);
    assert_int_equal(exr_add_channel(context, 0, "F", EXR_PIXEL_FLOAT, 0, 1, 1), 0);
    assert_int_equal(exr_add_channel(context, 0, "H", EXR_PIXEL_HALF, 0, 1, 1), 0);
    assert_int_equal(exr_add_channel(context, 0, "U", EXR_PIXEL_UINT, 0, 1, 1), 0);
    assert_int_equal(exr_write_header(context), 0);
    int32_t lines;
    assert_int_equal(exr_get_scanlines_per_chunk(context, 0, &lines), 0);
    for (int line = 0; line < SMALL_HEIGHT; line += lines) {
        const int first = line * SMALL_WIDTH;
        const void *const samples[] = { floats + first, halves + first, integers + first };
        exr_chunk_info_t chunk;
        assert_int_equal(exr_write_scanline_chunk_info(context, 0, y + line, &chunk), 0);
        write_chunk(context, 0, &chunk, samples, 3);
    }
    assert_int_equal(exr_finish(&context), 0);
    return bytes;
}

/* Texels are numbered in level 0, zeros in others. */
static void write_level(exr_context_t context, int level, int32_t side)
{
    float *tile = calloc((size_t)side * (size_t)side, sizeof(float));
    const void *const samples[] = { tile };
    int32_t width, height;

    assert_int_equal(exr_get_level_sizes(context, 0, level, level, &width, &height), 0);
    const int columns = (width + side - 1) / side, rows = (height + side - 1) / side;
    for (int i = 0; i < columns * rows; i++) {
        exr_chunk_info_t chunk;
        const int x = i % columns, y = i / columns;
        assert_int_equal(exr_write_tile_chunk_info(context, 0, x, y, level, level, &chunk), 0);
        for (int t = 0; t < chunk.width * chunk.height && level == 0; t++) {
            const int row = y * side + t / chunk.width, column = x * side + t % chunk.width;
            tile[t] = (float)(row * width + column);
        }
        write_chunk(context, 0, &chunk, samples, 1);
    }
    free(tile);
}

static struct bytes write_tiles(int32_t width, int32_t height, int32_t side,
                                exr_tile_level_mode_t mode)
{
    exr_context_t context = NULL;
    struct bytes bytes;
    int part, level_count;

    start_write(&context, &bytes);
    assert_int_equal(exr_add_part(context, NULL, EXR_STORAGE_TILED, &part), 0);
    assert_int_equal(
        exr_initialize_required_attr_simple(context, 0, width, height, EXR_COMPRESSION_ZIP), 0);
    assert_int_equal(exr_set_tile_descriptor(context, 0, (uint32_t)side, (uint32_t)side, mode,
                                             EXR_TILE_ROUND_DOWN),
                     0);
    assert_int_equal(exr_add_channel(context, 0, "Y", EXR_PIXEL_FLOAT, 0, 1, 1), 0);
    assert_int_equal(exr_write_header(context), 0);
    assert_int_equal(exr_get_tile_levels(context, 0, &level_count, &level_count), 0);
    for (int level = 0; level < level_count; level++)
        write_level(context, level, side);
    assert_int_equal(exr_finish(&context), 0);
    return bytes;
}

static void check_three_types(const struct bytes *bytes)
{
    struct image image = { 0 };
    assert_int_equal(read_bytes(bytes, &image), STATUS_OK);
    assert_int_equal(image.width, SMALL_WIDTH);
    assert_int_equal(image.height, SMALL_HEIGHT);
    assert_int_equal(image.plane_count, 3);
    for (int i = 0; i < SMALL_COUNT; i++) {
        assert_true(image_find(&image, "F")[i] == 0.25f * (float)i);
        assert_true(image_find(&image, "H")[i] == 1.0f + (float)i / 1024.0f);
        assert_true(image_find(&image, "U")[i] == 1000.0f * (float)i);
    }
    assert_false(image.planes[0].half);
    assert_true(image.planes[1].half);
    assert_false(image.planes[2].half);
    image_finish(&image);
}

static void test_types_and_windows(void **state)
{
    static const exr_compression_t compressions[] = {
        EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE, EXR_COMPRESSION_ZIPS,
        EXR_COMPRESSION_ZIP,  EXR_COMPRESSION_PIZ, EXR_COMPRESSION_PXR24,
    };
    (void)state;
    for (size_t i = 0; i < sizeof(compressions) / sizeof(compressions[0]); i++) {
        const struct bytes at_origin = write_three_types(compressions[i], 0, 0);
        check_three_types(&at_origin);
        free(at_origin.data);
        const struct bytes elsewhere = write_three_types(compressions[i], -5, 11);
        check_three_types(&elsewhere);
        free(elsewhere.data);
    }
}

static void test_tiles(void **state)
{
    static const exr_tile_level_mode_t modes[] = { EXR_TILE_ONE_LEVEL, EXR_TILE_MIPMAP_LEVELS };
    (void)state;
    for (int m = 0; m < 2; m++) {
        const struct bytes bytes = write_tiles(37, 21, 16, modes[m]);
        struct image image = { 0 };
        assert_int_equal(read_bytes(&bytes, &image), STATUS_OK);
        assert_int_equal(image.width, 37);
        assert_int_equal(image.height, 21);
        for (int i = 0; i < 37 * 21; i++)
            assert_true(image.planes[0].texels[i] == (float)i);
        image_finish(&image);
        free(bytes.data);
    }
}

/* Adds a part of one row of two texels; returns its number. */
static int add_part(exr_context_t context, const char *name, const char *const channels[],
                    int channel_count)
{
    int part;
    assert_int_equal(exr_add_part(context, name, EXR_STORAGE_SCANLINE, &part), 0);
    assert_int_equal(exr_initialize_required_attr_simple(context, part, 2, 1, EXR_COMPRESSION_NONE),
                     0);
    for (int c = 0; c < channel_count; c++)
        assert_int_equal(exr_add_channel(context, part, channels[c], EXR_PIXEL_FLOAT, 0, 1, 1), 0);
    return part;
}

/* The part with colours is read, wherever it is; without one, the first. */
static void test_parts(void **state)
{
    static const char *const depth[] = { "Z" }, *const colors[] = { "B", "G", "R" };
    static const float texels[] = { 1, 2, 3, 4, 5, 6 };
    static const void *const samples[] = { texels, texels + 2, texels + 4 };
    (void)state;
    for (int count = 1; count <= 3; count += 2) {
        exr_context_t context = NULL;
        struct bytes bytes;
        struct image image = { 0 };
        start_write(&context, &bytes);
        add_part(context, "depth", depth, 1);
        add_part(context, "colors", colors, count);
        assert_int_equal(exr_write_header(context), 0);
        for (int part = 0; part < 2; part++) {
            exr_chunk_info_t chunk;
            assert_int_equal(exr_write_scanline_chunk_info(context, part, 0, &chunk), 0);
            write_chunk(context, part, &chunk, samples, part ? count : 1);
        }
        assert_int_equal(exr_finish(&context), 0);
        assert_int_equal(read_bytes(&bytes, &image), STATUS_OK);
        assert_non_null(image_find(&image, count == 3 ? "R" : "Z"));
        assert_int_equal(image.plane_count, count);
        if (count == 3)
            assert_true(image_find(&image, "R")[1] == 6.0f);
        image_finish(&image);
        free(bytes.data);
    }
}

/* A header of one channel, no chunk behind it. */
static struct bytes write_header_only(exr_storage_t storage, int32_t width, int32_t height,
                                      int sampling)
{
    exr_context_t context = NULL;
    struct bytes bytes;
    int part;
    start_write(&context, &bytes);
    assert_int_equal(exr_add_part(context, NULL, storage, &part), 0);
    assert_int_equal(
        exr_initialize_required_attr_simple(context, 0, width, height, EXR_COMPRESSION_ZIPS), 0);
    if (storage == EXR_STORAGE_DEEP_SCANLINE)
        assert_int_equal(exr_set_version(context, 0, 1), 0);
    assert_int_equal(exr_add_channel(context, 0, "RY", EXR_PIXEL_FLOAT, 0, sampling, sampling), 0);
    assert_int_equal(exr_write_header(context), 0);
    exr_finish(&context); /* complains that chunks are missing */
    return bytes;
}

/* Reads while stderr goes into a file, whose text it returns. */
static enum status read_log(const struct bytes *bytes, struct image *image, char text[static 256])
{
    FILE *log = tmpfile();
    const int saved = dup(STDERR_FILENO);

    assert_non_null(log);
    dup2(fileno(log), STDERR_FILENO);
    const enum status status = read_bytes(bytes, image);
    dup2(saved, STDERR_FILENO);
    close(saved);
    rewind(log);
    memset(text, 0, 256);
    assert_true(fread(text, 1, 255, log) > 0);
    fclose(log);
    return status;
}

static void test_unsupported(void **state)
{
    static const struct image empty;

    static const struct {
        exr_storage_t storage;
        int32_t width, height;
        int sampling;
        const char *word; /* of the one line logged */
    } cases[] = {
        { EXR_STORAGE_DEEP_SCANLINE, 4, 4, 1, "deep" },
        { EXR_STORAGE_SCANLINE, 4, 4, 2, "subsampled" },
        { EXR_STORAGE_SCANLINE, 4, 4, 1, "chunk" }, /* there are none */
        { EXR_STORAGE_SCANLINE, 65537, 1, 1, "65537" },
        { EXR_STORAGE_SCANLINE, 1, 65537, 1, "65537" },
        { EXR_STORAGE_SCANLINE, 32768, 8193, 1, "out of range" },
    };

    (void)state;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const struct bytes bytes =
            write_header_only(cases[i].storage, cases[i].width, cases[i].height, cases[i].sampling);
        struct image image = { 0 };
        char text[256];
        assert_int_equal(read_log(&bytes, &image, text), STATUS_DATA);
        assert_non_null(strstr(text, cases[i].word));
        assert_ptr_equal(strchr(text, '\n'), text + strlen(text) - 1);
        assert_memory_equal(&image, &empty, sizeof(empty));
        free(bytes.data);
    }
}

/* The last row of a picture that is not packed, short of some bytes. */
static void test_short_row(void **state)
{
    const int32_t row_size = SMALL_WIDTH * (4 + 2 + 4), left = row_size - 10;
    struct bytes bytes = write_three_types(EXR_COMPRESSION_NONE, 0, 0);
    struct image image = { 0 };

    (void)state;
    memcpy((char *)bytes.data + bytes.size - row_size - 4, &left, 4);
    bytes.size -= 10;
    assert_int_equal(read_bytes(&bytes, &image), STATUS_DATA);
    free(bytes.data);
}

static int remove_file(void **state)
{
    (void)state;
    unlink(path);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_types_and_windows),
        cmocka_unit_test(test_tiles),
        cmocka_unit_test(test_parts),
        cmocka_unit_test(test_unsupported),
        cmocka_unit_test(test_short_row),
    };
    const int file = mkstemp(path);
    if (file < 0 || close(file) != 0)
        return 1;
    return cmocka_run_group_tests(tests, NULL, remove_file);
}
