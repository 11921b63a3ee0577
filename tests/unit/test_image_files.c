/* test_image_files.c: writing of PNG files and reading of Radiance HDR files. */
#include <fcntl.h>
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "src/file/hdr.h"
#include "src/file/png.h"
#include "tests/support/assertions.h"
#include "tests/support/temporary_folder.h"

static void save(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* -- PNG -- */

enum {
    PNG_WIDTH = 31,
    PNG_HEIGHT = 17,
    PNG_COUNT = PNG_WIDTH * PNG_HEIGHT
};

static void fill_rgba(uint8_t rgba[static 4 * PNG_COUNT])
{
    for (int i = 0; i < 4 * PNG_COUNT; i++)
        rgba[i] = (uint8_t)(i * 7 + i / 50);
}

static enum status encode_png(const uint8_t *rgba, uint32_t width, uint32_t height, void **data,
                              size_t *size)
{
    return png_encode(&(struct png_image_source){ .rgba = rgba, .width = width, .height = height },
                      data, size);
}

static void test_png_round_trip(void **state)
{
    uint8_t rgba[4 * PNG_COUNT], rgb[3 * PNG_COUNT];
    png_image png = { .version = PNG_IMAGE_VERSION };
    void *data;
    size_t size;

    (void)state;
    fill_rgba(rgba);
    assert_int_equal(encode_png(rgba, PNG_WIDTH, PNG_HEIGHT, &data, &size), STATUS_OK);
    assert_true(png_image_begin_read_from_memory(&png, data, size));
    assert_int_equal(png.width, PNG_WIDTH);
    assert_int_equal(png.height, PNG_HEIGHT);
    assert_int_equal(png.format, PNG_FORMAT_RGB);
    assert_true(png_image_finish_read(&png, NULL, rgb, 0, NULL));
    for (size_t i = 0; i < PNG_COUNT; i++)
        assert_memory_equal(&rgb[3 * i], &rgba[4 * i], 3);
    free(data);
}

/* Only these chunks, of which sRGB says "perceptual": no time of day. */
static void test_png_chunks(void **state)
{
    static const char names[] = "IHDR sRGB IDAT IEND ";
    uint8_t rgba[4 * PNG_COUNT];
    char found[64] = "";
    void *data;
    size_t size;

    (void)state;
    fill_rgba(rgba);
    assert_int_equal(encode_png(rgba, PNG_WIDTH, PNG_HEIGHT, &data, &size), STATUS_OK);
    const uint8_t *bytes = data;
    for (size_t at = 8; at + 12 <= size && strlen(found) < 50;) {
        const size_t length = (size_t)bytes[at + 2] << 8 | bytes[at + 3];
        strncat(found, (const char *)bytes + at + 4, 4);
        strncat(found, " ", 2);
        if (memcmp(bytes + at + 4, "sRGB", 4) == 0)
            assert_int_equal(bytes[at + 8], PNG_sRGB_INTENT_PERCEPTUAL);
        at += 12 + length;
    }
    assert_string_equal(found, names);
    free(data);
}

static void test_png_sizes(void **state)
{
    const uint8_t texel[4] = { 1, 2, 3, 4 };
    void *data;
    size_t size;

    (void)state;
    assert_int_equal(encode_png(texel, 1, 1, &data, &size), STATUS_OK);
    free(data);
    assert_int_equal(encode_png(texel, 0, 1, &data, &size), STATUS_FAILED);
    assert_null(data);
    assert_int_equal(encode_png(texel, 65536, 65536, &data, &size), STATUS_FAILED);
    assert_null(data);
}

/* -- Radiance HDR -- */

#define HDR_HEAD "#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\n\n"

struct hdr {
    unsigned char bytes[512];
    size_t size;
};

static void put(struct hdr *hdr, const void *bytes, size_t size)
{
    assert_true(hdr->size + size <= sizeof(hdr->bytes));
    memcpy(hdr->bytes + hdr->size, bytes, size);
    hdr->size += size;
}

static void put_text(struct hdr *hdr, const char *text)
{
    put(hdr, text, strlen(text));
}

static enum status read_hdr(const struct hdr *hdr, size_t size, struct image *image)
{
    save("a.hdr", hdr->bytes, size);
    return hdr_read("a.hdr", image, NULL, NULL);
}

static void check_refused(const struct hdr *hdr, size_t size)
{
    static const struct image empty;
    struct image image = { 0 };
    assert_int_equal(read_hdr(hdr, size, &image), STATUS_DATA);
    assert_memory_equal(&image, &empty, sizeof(empty));
}

static void check_texel(const struct image *image, size_t i, float r, float g, float b)
{
    assert_true(image_find(image, "R")[i] == r);
    assert_true(image_find(image, "G")[i] == g);
    assert_true(image_find(image, "B")[i] == b);
}

/* Mantissas count 2^(exponent - 136). */
static void make_flat(struct hdr *hdr)
{
    static const unsigned char texels[4][4] = {
        { 128, 64, 0, 129 }, { 255, 1, 2, 136 }, { 9, 9, 9, 0 }, { 128, 0, 200, 100 }
    };
    *hdr = (struct hdr){ .size = 0 };
    put_text(hdr, HDR_HEAD "-Y 2 +X 2\n");
    put(hdr, texels, sizeof(texels));
}

/* Row 0 in runs and dumps, row 1 in runs alone. */
static void make_runs(struct hdr *hdr)
{
    static const unsigned char rows[] = {
        2,       2,   0,  9,  128 + 9, 128,        /* R: nine of 1 */
        4,       8,   16, 32, 64,      128 + 5, 2, /* G: four, then five equal ones */
        9,       0,   1,  2,  3,       4,       5,       6,  7,       8, /* B */
        128 + 9, 129,                                                    /* exponents */
        2,       2,   0,  9,  128 + 9, 64,      128 + 9, 32, 128 + 9, 16, 128 + 9, 129,
    };
    *hdr = (struct hdr){ .size = 0 };
    put_text(hdr, HDR_HEAD "-Y 2 +X 9\n");
    put(hdr, rows, sizeof(rows));
}

static void test_hdr_flat(void **state)
{
    struct hdr hdr;
    struct image image = { 0 };

    (void)state;
    make_flat(&hdr);
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    assert_int_equal(image.width, 2);
    assert_int_equal(image.height, 2);
    assert_int_equal(image.plane_count, 3);
    check_texel(&image, 0, 1.0f, 0.5f, 0.0f);
    check_texel(&image, 1, 255.0f, 1.0f, 2.0f);
    check_texel(&image, 2, 0.0f, 0.0f, 0.0f);
    check_texel(&image, 3, 0x1p-29f, 0.0f, 200 * 0x1p-36f);
    image_finish(&image);
}

static void test_hdr_runs(void **state)
{
    struct hdr hdr;
    struct image image = { 0 };

    (void)state;
    make_runs(&hdr);
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    assert_int_equal(image.width, 9);
    assert_int_equal(image.height, 2);
    for (size_t x = 0; x < 9; x++) {
        const float g = x < 4 ? (float)(8 << x) : 2.0f;
        check_texel(&image, x, 1.0f, g / 128.0f, (float)x / 128.0f);
        check_texel(&image, 9 + x, 0.5f, 0.25f, 0.125f);
    }
    image_finish(&image);
}

/* Wide enough for runs, but flat; and longer than what stb_image reads at once. */
static void test_hdr_wide_flat(void **state)
{
    struct hdr hdr = { .size = 0 };
    struct image image = { 0 };

    (void)state;
    put_text(&hdr, HDR_HEAD "-Y 5 +X 16\n");
    for (int i = 0; i < 80; i++)
        put(&hdr, (unsigned char[]){ 128, (unsigned char)i, 0, 128 + 8 }, 4);
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    for (size_t i = 0; i < 80; i++)
        check_texel(&image, i, 128.0f, (float)i, 0.0f);
    image_finish(&image);
    for (size_t size = hdr.size - 1; size > hdr.size - 300; size--)
        check_refused(&hdr, size);
}

static void test_hdr_cut_short(void **state)
{
    struct hdr hdr;

    (void)state;
    make_flat(&hdr);
    for (size_t size = 0; size < hdr.size; size++)
        check_refused(&hdr, size);
    make_runs(&hdr);
    for (size_t size = 0; size < hdr.size; size++)
        check_refused(&hdr, size);
}

/* Runs of no length: stb_image 2.27 waits for ever for a run at the end of such a file. */
static void test_hdr_endless_runs(void **state)
{
    static const unsigned char zeros[64];
    struct hdr hdr = { .size = 0 };

    (void)state;
    put_text(&hdr, HDR_HEAD "-Y 1 +X 9\n");
    put(&hdr, (unsigned char[]){ 2, 2, 0, 9 }, 4);
    put(&hdr, zeros, sizeof(zeros));
    check_refused(&hdr, hdr.size);
}

static void test_hdr_headers(void **state)
{
    static const char *const headers[] = {
        "",
        "P6 1 1 255\n...",
        "#?RADIANCE\n",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgb\n\n-Y 1 +X 1\n....",
        HDR_HEAD "+Y 1 -Y 1\n....",
        HDR_HEAD "-Y 1 X 1\n....",
        HDR_HEAD "-Y 1 +X 1 9\n....",
        HDR_HEAD "-Y 1\n....",
        HDR_HEAD "-Y 0 +X 1\n....",
        HDR_HEAD "-Y -1 +X 1\n....",
        HDR_HEAD "-Y 65537 +X 1\n....",
        HDR_HEAD "-Y 1 +X 65537\n....",
        HDR_HEAD "-Y 65536 +X 4097\n....",
        HDR_HEAD "-Y 65536 +X 4096\n....", /* in range, but where is the rest? */
        HDR_HEAD "-Y 1 +X 1\n...",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(headers) / sizeof(headers[0]); i++) {
        struct hdr hdr = { .size = 0 };
        put_text(&hdr, headers[i]);
        check_refused(&hdr, hdr.size);
    }
}

/* Runs of the old encoding: 1, 1, 1, n repeats n times; after another run, 256 n times. */
static void test_hdr_old_runs(void **state)
{
    static const unsigned char texels[] = { 128, 0, 0, 129, 1,   1, 1, 3,   1, 1, 1, 1,
                                            0,   9, 0, 136, 128, 0, 0, 129, 1, 1, 1, 39 };
    struct hdr hdr = { .size = 0 };
    struct image image = { 0 };

    (void)state;
    put_text(&hdr, HDR_HEAD "-Y 1 +X 301\n");
    put(&hdr, texels, sizeof(texels));
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    for (size_t i = 0; i < 301; i++)
        check_texel(&image, i, i != 260, i == 260 ? 9 : 0, 0);
    image_finish(&image);
    check_refused(&hdr, hdr.size - 1);
    for (size_t i = 0; i < 2; i++) { /* a run beyond the line; another one */
        hdr.size = 0;
        put_text(&hdr, i ? HDR_HEAD "-Y 1 +X 300\n" : HDR_HEAD "-Y 1 +X 259\n");
        put(&hdr, texels, sizeof(texels));
        check_refused(&hdr, hdr.size);
    }
    hdr.size = 0;
    put_text(&hdr, HDR_HEAD "-Y 1 +X 9\n"); /* nothing to repeat */
    put(&hdr, (unsigned char[]){ 1, 1, 1, 9, 1, 1, 1, 9 }, 8);
    check_refused(&hdr, hdr.size);
}

/* Texels of one column of values 1, 2, 4 and one of 8, 16, 32, in all orders. */
static void test_hdr_orientations(void **state)
{
    static const struct {
        const char *resolution;
        unsigned char order[6]; /* of texels of the image, row by row */
    } all[] = {
        { "-Y 3 +X 2\n", { 0, 1, 2, 3, 4, 5 } }, { "-Y 3 -X 2\n", { 1, 0, 3, 2, 5, 4 } },
        { "+Y 3 +X 2\n", { 4, 5, 2, 3, 0, 1 } }, { "+Y 3 -X 2\n", { 5, 4, 3, 2, 1, 0 } },
        { "+X 2 -Y 3\n", { 0, 2, 4, 1, 3, 5 } }, { "+X 2 +Y 3\n", { 4, 2, 0, 5, 3, 1 } },
        { "-X 2 -Y 3\n", { 1, 3, 5, 0, 2, 4 } }, { "-X 2 +Y 3\n", { 5, 3, 1, 4, 2, 0 } },
    };

    (void)state;
    for (size_t k = 0; k < 8; k++) {
        struct hdr hdr = { .size = 0 };
        struct image image = { 0 };
        put_text(&hdr, HDR_HEAD);
        put_text(&hdr, all[k].resolution);
        for (size_t i = 0; i < 6; i++)
            put(&hdr, (unsigned char[]){ all[k].order[i] + 10, 0, 0, 136 }, 4);
        assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
        assert_int_equal(image.width, 2);
        assert_int_equal(image.height, 3);
        for (size_t i = 0; i < 6; i++)
            check_texel(&image, i, (float)i + 10, 0, 0);
        image_finish(&image);
    }
}

/* One texel of value 2, 4, 8 under a header. */
static void check_head(const char *head, float r, float g, float b)
{
    struct hdr hdr = { .size = 0 };
    struct image image = { 0 };
    put_text(&hdr, head);
    put(&hdr, (unsigned char[]){ 32, 64, 128, 132 }, 4);
    assert_int_equal(read_hdr(&hdr, hdr.size, &image), STATUS_OK);
    assert_true(fabsf(image.planes[0].texels[0] - r) < 5e-3f);
    assert_true(fabsf(image.planes[1].texels[0] - g) < 5e-3f);
    assert_true(fabsf(image.planes[2].texels[0] - b) < 5e-3f);
    image_finish(&image);
}

static void test_hdr_variables(void **state)
{
    (void)state;
    check_head("#?RGBE\r\nFORMAT=32-bit_rle_rgbe \r\nPIXASPECT=2\r\n\r\n-Y 1 +X 1\r\n", 2, 4, 8);
    check_head("#?RADIANCE\nEXPOSURE=2\nCOLORCORR= 1 2 .5\n\tEXPOSURE=9\nEXPOSURE= 2.0\n"
               "COLORCORR=1 1 4\n\n-Y 1 +X 1\n",
               0.5f, 0.5f, 1);
    check_head("#?RADIANCE\nEXPOSURE=0\nEXPOSURE=nan\nCOLORCORR=1 2\n\n-Y 1 +X 1\n", 2, 4, 8);
    check_head("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", -3.656f, 5.897f, 7.751f);
    check_head("#?RADIANCE\nPRIMARIES=.15 .06 .64 .33 .3 .6 .3127 .329\n\n-Y 1 +X 1\n", 4, 8, 2);
}

static void test_hdr_no_input(void **state)
{
    struct image image = { 0 };
    (void)state;
    assert_int_equal(hdr_read("none.hdr", &image, NULL, NULL), STATUS_NO_INPUT);
    assert_int_equal(hdr_read(".", &image, NULL, NULL), STATUS_NO_INPUT);
    assert_int_equal(image.plane_count, 0);
}

static void test_hdr_refuses_png(void **state)
{
    uint8_t rgba[4 * PNG_COUNT];
    struct image image = { 0 };
    void *data;
    size_t size;

    (void)state;
    fill_rgba(rgba);
    assert_int_equal(encode_png(rgba, PNG_WIDTH, PNG_HEIGHT, &data, &size), STATUS_OK);
    save("a.png", data, size);
    free(data);
    assert_int_equal(hdr_read("a.png", &image, NULL, NULL), STATUS_DATA);
}

#define TEST(name) \
    cmocka_unit_test_setup_teardown(name, temporary_folder_enter, temporary_folder_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_png_round_trip), TEST(test_png_chunks),       TEST(test_png_sizes),
        TEST(test_hdr_flat),       TEST(test_hdr_runs),         TEST(test_hdr_wide_flat),
        TEST(test_hdr_cut_short),  TEST(test_hdr_endless_runs), TEST(test_hdr_headers),
        TEST(test_hdr_no_input),   TEST(test_hdr_old_runs),     TEST(test_hdr_orientations),
        TEST(test_hdr_variables),  TEST(test_hdr_refuses_png),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
