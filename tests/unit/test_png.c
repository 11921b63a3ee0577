/* test_png.c: text chunks of PNG files, and checks of existing files. */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/file/png.h"
#include "tests/support/assertions.h"
#include "tests/support/temporary_folder.h"

enum {
    WIDTH = 9,
    HEIGHT = 5,
    TEXEL_COUNT = WIDTH * HEIGHT
};

static const char path[] = "a.png";
static const struct image_text texts[] = {
    { "firn/version", "1.2.3" },
    { "firn/settings", "scene=Gletscher \xc3\xb6 env=\xe2\x9d\x84.exr" },
    { "firn/note", "" },
};

enum {
    TEXT_COUNT = sizeof(texts) / sizeof(texts[0])
};

static struct png_image_source make_picture(void)
{
    static const uint8_t rgba[4 * TEXEL_COUNT] = { 1, 2, 3, 4, 50, 60, 70, 80 };
    return (struct png_image_source){ rgba, WIDTH, HEIGHT, texts, TEXT_COUNT };
}

static uint8_t *encode(const struct png_image_source *picture, size_t *size)
{
    void *data;
    assert_int_equal(png_encode(picture, &data, size), STATUS_OK);
    return data;
}

static void save(const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* What libpng itself reads, which checks every sum. */
static void check_texts_by_libpng(FILE *file)
{
    png_textp found;
    int count;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);

    assert_non_null(info);
    if (setjmp(png_jmpbuf(png)))
        fail_msg("libpng cannot read it");
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, NULL);
    assert_int_equal(png_get_text(png, info, &found, &count), TEXT_COUNT);
    for (int i = 0; i < TEXT_COUNT; i++) {
        assert_string_equal(found[i].key, texts[i].name);
        assert_string_equal(found[i].text, texts[i].value);
    }
    assert_int_equal(found[0].compression, PNG_TEXT_COMPRESSION_NONE);
    assert_int_equal(found[1].compression, PNG_ITXT_COMPRESSION_NONE);
    assert_int_equal(found[1].itxt_length, strlen(texts[1].value));
    png_destroy_read_struct(&png, &info, NULL);
}

static void test_texts(void **state)
{
    const struct png_image_source picture = make_picture();
    size_t size;
    uint8_t *data = encode(&picture, &size);

    (void)state;
    FILE *file = fmemopen(data, size, "rb");
    assert_non_null(file);
    check_texts_by_libpng(file);
    fclose(file);
    free(data);
}

static void test_texts_leave_the_texels(void **state)
{
    const struct png_image_source picture = make_picture();
    png_image png = { .version = PNG_IMAGE_VERSION };
    uint8_t rgb[3 * TEXEL_COUNT];
    size_t size;
    uint8_t *data = encode(&picture, &size);

    (void)state;
    assert_true(png_image_begin_read_from_memory(&png, data, size));
    png.format = PNG_FORMAT_RGB;
    assert_true(png_image_finish_read(&png, NULL, rgb, 0, NULL));
    for (size_t i = 0; i < TEXEL_COUNT; i++)
        assert_memory_equal(rgb + 3 * i, picture.rgba + 4 * i, 3);
    free(data);
}

/* Whether the file is whole and that of the picture. */
static bool file_matches(const struct png_image_source *picture)
{
    struct image_header head;
    const bool matches = png_check(path, &head) == STATUS_OK && png_matches(&head, picture);
    image_header_finish(&head);
    return matches;
}

static void test_matches(void **state)
{
    struct png_image_source picture = make_picture();
    size_t size;
    uint8_t *data = encode(&picture, &size);

    (void)state;
    save(data, size);
    free(data);
    picture.rgba = NULL;
    assert_true(file_matches(&picture));
    picture.texts = texts + 1; /* fewer */
    picture.text_count = 1;
    assert_true(file_matches(&picture));
    picture.text_count = 0;
    assert_true(file_matches(&picture));
    picture.width = WIDTH + 1;
    assert_false(file_matches(&picture));
    picture.width = WIDTH;
    picture.height = HEIGHT - 1;
    assert_false(file_matches(&picture));
}

static void test_other_texts(void **state)
{
    static const struct image_text others[] = {
        { "firn/version", "1.2.4" },
        { "firn/version", "1.2.30" },
        { "firn/version", "1.2." },
        { "firn/Version", "1.2.3" },
        { "firn/version", "" },
        { "firn", "version" },
        { "firn/settings", "scene=Gletscher o env=*.exr" },
    };
    struct png_image_source picture = make_picture();
    size_t size;
    uint8_t *data = encode(&picture, &size);

    (void)state;
    save(data, size);
    free(data);
    picture.text_count = 1;
    for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); i++) {
        picture.texts = &others[i];
        assert_false(file_matches(&picture));
    }
}

static void test_cut_short(void **state)
{
    const struct png_image_source picture = make_picture();
    size_t size;
    uint8_t *data = encode(&picture, &size);

    (void)state;
    for (size_t shorter = 0; shorter < size; shorter++) {
        save(data, shorter);
        assert_false(file_matches(&picture));
    }
    data = realloc(data, size + 1);
    assert_non_null(data);
    data[size] = 0;
    save(data, size + 1); /* or longer */
    assert_false(file_matches(&picture));
    free(data);
}

static void test_damaged(void **state)
{
    const struct png_image_source picture = make_picture();
    size_t size;
    uint8_t *data = encode(&picture, &size);

    (void)state;
    for (size_t i = 0; i < size; i++) {
        data[i] ^= 0x10;
        save(data, size);
        assert_false(file_matches(&picture));
        data[i] ^= 0x10;
    }
    save(data, size);
    assert_true(file_matches(&picture));
    free(data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texts),     cmocka_unit_test(test_texts_leave_the_texels),
        cmocka_unit_test(test_matches),   cmocka_unit_test(test_other_texts),
        cmocka_unit_test(test_cut_short), cmocka_unit_test(test_damaged),
    };
    return cmocka_run_group_tests(tests, temporary_folder_enter, temporary_folder_leave);
}
