/* test_png_read.c: PNG files of other programs, and damaged ones, read as linear planes. */
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#include "src/file/png.h"
#include "tests/support/assertions.h"
#include "tests/support/temporary_folder.h"

enum {
    WIDTH = 7,
    HEIGHT = 3,
    COUNT = WIDTH * HEIGHT
};

static const char path[] = "a.png";

/* As libpng makes it of texels of this format. */
static void make_file(uint32_t format, const void *texels)
{
    png_image png = {
        .version = PNG_IMAGE_VERSION,
        .width = WIDTH,
        .height = HEIGHT,
        .format = format,
    };
    assert_true(png_image_write_to_file(&png, path, 0, texels, 0, NULL));
}

static enum status read_file(struct image *image)
{
    *image = (struct image){ 0 };
    return png_read(path, image, NULL, NULL);
}

/* sRGB, as IEC 61966-2-1 prints it. */
static double decode(int level)
{
    const double x = level / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

static void check_plane(const struct image *image, const char *name, size_t at, double value)
{
    const float *texels = image_find(image, name);
    assert_non_null(texels);
    CHECK_NEAR(texels[at], value, 1e-6);
}

static void test_colors(void **state)
{
    uint8_t rgb[3 * COUNT];
    struct image image;

    (void)state;
    for (int i = 0; i < 3 * COUNT; i++)
        rgb[i] = (uint8_t)(i * 4);
    make_file(PNG_FORMAT_RGB, rgb);
    assert_int_equal(read_file(&image), STATUS_OK);
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    assert_int_equal(image.plane_count, 3);
    for (size_t i = 0; i < COUNT; i++) {
        check_plane(&image, "R", i, decode(rgb[3 * i]));
        check_plane(&image, "G", i, decode(rgb[3 * i + 1]));
        check_plane(&image, "B", i, decode(rgb[3 * i + 2]));
    }
    image_finish(&image);
}

/* Colours are not multiplied by it, and it is no colour. */
static void test_alpha(void **state)
{
    uint8_t rgba[4 * COUNT] = { 200, 100, 50, 128, 255, 255, 255, 0 };
    struct image image;

    (void)state;
    make_file(PNG_FORMAT_RGBA, rgba);
    assert_int_equal(read_file(&image), STATUS_OK);
    assert_int_equal(image.plane_count, 4);
    check_plane(&image, "R", 0, decode(200));
    check_plane(&image, "A", 0, 128 / 255.0);
    check_plane(&image, "A", 1, 0);
    image_finish(&image);
}

static void test_grey(void **state)
{
    uint8_t grey[COUNT] = { 10, 128, 255 };
    struct image image;

    (void)state;
    make_file(PNG_FORMAT_GRAY, grey);
    assert_int_equal(read_file(&image), STATUS_OK);
    assert_int_equal(image.plane_count, 3);
    for (size_t i = 0; i < 3; i++) {
        check_plane(&image, "R", i, decode(grey[i]));
        check_plane(&image, "B", i, decode(grey[i]));
    }
    image_finish(&image);
}

/* libpng's 16 bits are linear light, which the file says; as sRGB it would be 0.214. */
static void test_linear_file(void **state)
{
    uint16_t rgb[3 * COUNT] = { 65535, 32768, 0 };
    struct image image;

    (void)state;
    make_file(PNG_FORMAT_LINEAR_RGB, rgb);
    assert_int_equal(read_file(&image), STATUS_OK);
    check_plane(&image, "R", 0, 1);
    CHECK_NEAR(image_find(&image, "G")[0], 0.5, 0.02);
    check_plane(&image, "B", 0, 0);
    image_finish(&image);
}

/* ---- damage ---- */

static size_t load(uint8_t *bytes, size_t size_max)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, size_max, file);
    assert_int_equal(fclose(file), 0);
    return size;
}

static void save(const uint8_t *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void test_cut_short_and_damaged(void **state)
{
    uint8_t rgb[3 * COUNT] = { 1, 2, 3 }, bytes[1024];
    struct image image;

    (void)state;
    make_file(PNG_FORMAT_RGB, rgb);
    const size_t size = load(bytes, sizeof(bytes));
    assert_true(size < sizeof(bytes));
    for (size_t shorter = 0; shorter < size - 16; shorter++) { /* all texels are there after it */
        save(bytes, shorter);
        assert_int_equal(read_file(&image), STATUS_DATA);
        assert_null(image.planes);
    }
    for (size_t i = 0; i < size; i++) {
        bytes[i] ^= 0x10;
        save(bytes, size);
        const enum status status = read_file(&image);
        assert_true(status == STATUS_OK || status == STATUS_DATA);
        assert_true(status == STATUS_OK || !image.planes);
        if (i < 33) /* signature and header, with its sum */
            assert_int_equal(status, STATUS_DATA);
        image_finish(&image);
        bytes[i] ^= 0x10;
    }
}

static void test_too_large(void **state)
{
    png_image png = {
        .version = PNG_IMAGE_VERSION,
        .width = IMAGE_MAX_SIDE,
        .height = 1,
        .format = PNG_FORMAT_GRAY,
    };
    uint8_t *grey = calloc(IMAGE_MAX_SIDE + 1, 1);
    struct image image;

    (void)state;
    assert_non_null(grey);
    assert_true(png_image_write_to_file(&png, path, 0, grey, 0, NULL));
    assert_int_equal(read_file(&image), STATUS_OK);
    image_finish(&image);
    png.width++;
    assert_true(png_image_write_to_file(&png, path, 0, grey, 0, NULL));
    assert_int_equal(read_file(&image), STATUS_DATA);
    assert_null(image.planes);
    free(grey);
}

/* libpng would clear 2 GiB of memory for it. */
static void test_chunk_longer_than_the_file(void **state)
{
    static const uint8_t chunk[24] = { 0x7f, 0xff, 0xff, 0xf0, 't', 'E', 'X', 't' };
    uint8_t rgb[3 * COUNT] = { 1 }, bytes[1024];
    struct image image;
    struct rusage usage;

    (void)state;
    make_file(PNG_FORMAT_RGB, rgb);
    load(bytes, sizeof(bytes));
    memcpy(bytes + 33, chunk, sizeof(chunk)); /* after the header */
    save(bytes, 33 + sizeof(chunk));
    assert_int_equal(read_file(&image), STATUS_DATA);
    assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
    assert_true(usage.ru_maxrss < 1 << 20); /* KiB */
}

static void test_missing(void **state)
{
    struct image image = { 0 };

    (void)state;
    assert_int_equal(png_read("gone.png", &image, NULL, NULL), STATUS_NO_INPUT);
    assert_int_equal(png_read(".", &image, NULL, NULL), STATUS_NO_INPUT);
    assert_null(image.planes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_colors),    cmocka_unit_test(test_alpha),
        cmocka_unit_test(test_grey),      cmocka_unit_test(test_linear_file),
        cmocka_unit_test(test_too_large), cmocka_unit_test(test_cut_short_and_damaged),
        cmocka_unit_test(test_missing),   cmocka_unit_test(test_chunk_longer_than_the_file),
    };
    return cmocka_run_group_tests(tests, temporary_folder_enter, temporary_folder_leave);
}
