/* test_exr.c: EXR files: bit-identical round trip, and rejection of damaged files. */
#include <OpenEXR/openexr.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "src/file/atomic_file.h"
#include "src/file/cryptomatte.h"
#include "src/file/exr.h"
#include "tests/support/assertions.h"

static char path[] = "/tmp/firn-test-exr-XXXXXX";

static const struct exr_header plain_header;

struct bytes {
    void *data;
    size_t size;
};

/* -- helpers -- */

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof(bits));
    return bits;
}

/* Exact in half: eighths below 256. */
static float sample(size_t plane, size_t i)
{
    return (float)((i * 37 + plane * 101) % 2048) / 8.0f;
}

static void make_image(struct image *image, uint32_t width, uint32_t height,
                       const char *const *names, uint32_t count)
{
    image_init(image, width, height);
    for (uint32_t p = 0; p < count; p++) {
        float *texels = image_add_plane(image, names[p], p % 2 == 0);
        assert_non_null(texels);
        for (size_t i = 0; i < (size_t)width * height; i++)
            texels[i] = sample(p, i) + (p % 2 ? 1e-5f * (float)i : 0.0f);
    }
}

static struct bytes encode(const struct image *image, const struct exr_header *header)
{
    struct bytes bytes;
    assert_int_equal(exr_encode(image, header, &bytes.data, &bytes.size), STATUS_OK);
    assert_non_null(bytes.data);
    return bytes;
}

/* Not by file_io_write(): thousands of files, and no need to sync them. */
static void save(const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static enum status read_image(const char *name, struct image *image)
{
    struct image_header head;
    const enum status status = exr_read(name, image, &head);
    image_header_finish(&head);
    return status;
}

static enum status read_bytes(const void *data, size_t size, struct image *image)
{
    save(data, size);
    return read_image(path, image);
}

static void check_empty(const struct image *image)
{
    static const struct image empty;
    assert_memory_equal(image, &empty, sizeof(empty));
}

static void check_refused(const void *data, size_t size)
{
    struct image image = { 0 };
    assert_int_equal(read_bytes(data, size, &image), STATUS_DATA);
    check_empty(&image);
}

static void check_same(const struct image *a, const struct image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->plane_count, b->plane_count);
    for (uint32_t p = 0; p < a->plane_count; p++) {
        const struct image_plane *plane = &a->planes[p];
        const float *texels = image_find(b, plane->name);
        assert_non_null(texels);
        assert_memory_equal(plane->texels, texels, sizeof(float) * a->width * a->height);
    }
}

static void check_round_trip(uint32_t width, uint32_t height, const char *const *names,
                             uint32_t count)
{
    struct image image = { 0 }, back = { 0 };
    make_image(&image, width, height, names, count);
    const struct bytes bytes = encode(&image, &plain_header);
    assert_int_equal(read_bytes(bytes.data, bytes.size, &back), STATUS_OK);
    check_same(&image, &back);
    for (uint32_t p = 0; p < count; p++) {
        const struct image_plane *plane = back.planes;
        while (strcmp(plane->name, names[p]) != 0)
            plane++;
        assert_int_equal(plane->half, image.planes[p].half);
    }
    free(bytes.data);
    image_finish(&image);
    image_finish(&back);
}

/* -- the library's own interface over bytes in memory -- */

static int64_t read_memory(exr_const_context_t context, void *user, void *to, uint64_t size,
                           uint64_t offset, exr_stream_error_func_ptr_t report)
{
    const struct bytes *bytes = user;
    (void)context;
    (void)report;
    if (offset > bytes->size)
        return -1;
    if (size > bytes->size - offset)
        size = bytes->size - offset;
    memcpy(to, (const char *)bytes->data + offset, size);
    return (int64_t)size;
}

/* -- round trips -- */

static void test_round_trips(void **state)
{
    static const char *const names[] = { "R",      "G", "B",  "A",         "N.X",      "back.N.Z",
                                         "exit.X", "Z", "id", "fresnel.X", "fresnel.Y" };
    static const uint32_t heights[] = { 1, 3, 15, 16, 17, 32, 33 };
    (void)state;
    for (size_t i = 0; i < sizeof(heights) / sizeof(heights[0]); i++) {
        check_round_trip(1, heights[i], names, 11);
        check_round_trip(23, heights[i], names, 11);
        check_round_trip(8, heights[i], names, 1);
        check_round_trip(8, heights[i], names, 4);
    }
}

static void test_long_names(void **state)
{
    static const char *const names[] = {
        "a-name-of-31-characters-exactly",
        "a-name-of-more-than-thirty-one-characters-wants-a-flag-in-file",
    };
    (void)state;
    check_round_trip(4, 4, names, 1);
    check_round_trip(4, 4, names, 2);
}

static void test_special_values(void **state)
{
    static const struct {
        float value, half;
    } cases[] = {
        { 0.0f, 0.0f },
        { -0.0f, -0.0f },
        { INFINITY, 65504.0f },
        { -INFINITY, -65504.0f },
        { 65504.0f, 65504.0f },
        { 65519.0f, 65504.0f },
        { 70000.0f, 65504.0f },
        { -70000.0f, -65504.0f },
        { 1e30f, 65504.0f },
        { -1e30f, -65504.0f },
        { 0x1p-24f, 0x1p-24f },           /* the least half */
        { 0x1.8p-24f, 0x1p-23f },         /* a tie: to even */
        { 0x1p-25f, 0.0f },               /* a tie: to even */
        { 0x1.8p-25f, 0x1p-24f },         /* beyond it */
        { -0x1.ff8p-15f, -0x1.ff8p-15f }, /* denormal as half */
        { 0x1p-149f, 0.0f },              /* denormal as float */
        { 1.0f + 0x1p-11f, 1.0f },        /* a tie: to even */
        { 1.0f + 0x3p-11f, 1.0f + 0x1p-9f },
        { 1.0f + 0x1.8p-11f, 1.0f + 0x1p-10f },
    };

    enum {
        COUNT = sizeof(cases) / sizeof(cases[0])
    };
    struct image image = { 0 }, back = { 0 };
    (void)state;
    image_init(&image, COUNT + 1, 1);
    float *halves = image_add_plane(&image, "half", true);
    float *floats = image_add_plane(&image, "float", false);
    for (size_t i = 0; i < COUNT; i++)
        halves[i] = floats[i] = cases[i].value;
    halves[COUNT] = floats[COUNT] = NAN;
    const struct bytes bytes = encode(&image, &plain_header);
    assert_int_equal(read_bytes(bytes.data, bytes.size, &back), STATUS_OK);
    halves = image_find(&back, "half");
    floats = image_find(&back, "float");
    for (size_t i = 0; i < COUNT; i++) {
        assert_int_equal(bits_of(halves[i]), bits_of(cases[i].half));
        assert_int_equal(bits_of(floats[i]), bits_of(cases[i].value));
    }
    assert_true(isnan(halves[COUNT]) && isnan(floats[COUNT]));
    free(bytes.data);
    image_finish(&image);
    image_finish(&back);
}

/* Integer planes are stored as rounded 32-bit unsigned integers. */
static void test_integers(void **state)
{
    static const float values[] = { 0.0f, 0.6f, 7.0f, 16777216.0f, 5e9f, -3.0f, NAN };
    static const float stored[] = { 0.0f, 1.0f, 7.0f, 16777216.0f, 4294967296.0f, 0.0f, 0.0f };
    struct image image = { 0 }, back = { 0 };
    (void)state;
    image_init(&image, 7, 1);
    memcpy(image_add_plane(&image, "a", false), values, sizeof(values));
    memcpy(image_add_plane(&image, "b", false), values, sizeof(values));
    image.planes[0].integer = true;
    const struct bytes bytes = encode(&image, &plain_header);
    assert_int_equal(read_bytes(bytes.data, bytes.size, &back), STATUS_OK);
    assert_true(back.planes[0].integer && !back.planes[1].integer);
    for (size_t i = 0; i < 7; i++) {
        assert_int_equal(bits_of(back.planes[0].texels[i]), bits_of(stored[i]));
        assert_int_equal(bits_of(image.planes[0].texels[i]), bits_of(values[i]));
    }
    free(bytes.data);
    image_finish(&image);
    image_finish(&back);
}

/* Hashes of the reference implementation of MurmurHash3, and IDs whose exponent is changed. */
static void test_cryptomatte(void **state)
{
    struct cryptomatte_texts texts = { 0 };
    (void)state;
    assert_int_equal(cryptomatte_hash(""), 0);
    assert_int_equal(cryptomatte_hash("hello"), 0x248bfa47);
    assert_int_equal(cryptomatte_hash("hello, world"), 0x149bbb7f);
    assert_int_equal(cryptomatte_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723);
    assert_int_equal(bits_of(cryptomatte_id("hello")), 0x248bfa47);
    assert_int_equal(bits_of(cryptomatte_id("")), 0x00800000);
    assert_true(cryptomatte_describe(&texts, "hello", "1 hello\n2 hello, world\n"));
    assert_string_equal(texts.all[0].name, "cryptomatte/248bfa4/name");
    assert_string_equal(texts.manifest, "{\"hello\":\"248bfa47\",\"hello, world\":\"149bbb7f\"}");
    cryptomatte_finish(&texts);
}

/* Some of these chunks pack to just as many bytes as they hold: a trap in the library. */
static void test_packed_as_long_as_unpacked(void **state)
{
    static const char *const names[] = { "c0", "c1", "c2" };
    (void)state;
    for (uint32_t seed = 0; seed < 200; seed++) {
        struct image image = { 0 }, back = { 0 };
        image_init(&image, 8, 1);
        for (uint32_t p = 0; p < 3; p++) {
            float *texels = image_add_plane(&image, names[p], true);
            for (size_t i = 0; i < 8; i++)
                texels[i] = sample(p, i + seed);
        }
        const struct bytes bytes = encode(&image, &plain_header);
        assert_int_equal(read_bytes(bytes.data, bytes.size, &back), STATUS_OK);
        check_same(&image, &back);
        free(bytes.data);
        image_finish(&image);
        image_finish(&back);
    }
}

/* Noise does not compress, so that such chunks are stored as they are, amid others. */
static void test_incompressible(void **state)
{
    struct image image = { 0 }, back = { 0 };
    uint32_t seed = 1;

    (void)state;
    image_init(&image, 64, 64);
    float *texels = image_add_plane(&image, "noise", false);
    for (int i = 0; i < 64 * 64; i++) {
        seed = seed * 1664525u + 1013904223u;
        const uint32_t bits = (seed >> 2) + 0x10000000u; /* finite */
        if (i / 64 / 16 % 2 == 0)
            memcpy(&texels[i], &bits, sizeof(bits));
    }
    const struct bytes bytes = encode(&image, &plain_header);
    assert_int_equal(read_bytes(bytes.data, bytes.size, &back), STATUS_OK);
    check_same(&image, &back);
    free(bytes.data);
    image_finish(&image);
    image_finish(&back);
}

/* -- the header -- */

static void check_matrix(exr_context_t context, const char *name, const float *expected)
{
    exr_attr_m44f_t matrix;
    assert_int_equal(exr_attr_get_m44f(context, 0, name, &matrix), 0);
    assert_memory_equal(matrix.m, expected, sizeof(matrix.m));
}

/* Besides the texts there is what says how the picture lies there: no time of day, no name. */
static void check_texts(exr_context_t context, const struct exr_header *header)
{
    static const char form[] = " channels compression dataWindow displayWindow lineOrder type "
                               "pixelAspectRatio screenWindowCenter screenWindowWidth "
                               "chromaticities worldToCamera worldToNDC ";
    uint32_t found = 0;
    int32_t count;
    assert_int_equal(exr_get_attribute_count(context, 0, &count), 0);
    for (int32_t i = 0; i < count; i++) {
        const exr_attribute_t *attribute;
        assert_int_equal(
            exr_get_attribute_by_index(context, 0, EXR_ATTR_LIST_FILE_ORDER, i, &attribute), 0);
        char word[64];
        snprintf(word, sizeof(word), " %s ", attribute->name);
        if (strstr(form, word))
            continue;
        assert_int_equal(attribute->type, EXR_ATTR_STRING);
        assert_true(found < header->text_count);
        assert_string_equal(attribute->name, header->texts[found].name);
        assert_string_equal(attribute->string->str, header->texts[found].value);
        found++;
    }
    assert_int_equal(found, header->text_count);
}

static void test_header(void **state)
{
    static const char *const names[] = { "Z", "B", "G", "R" };
    static const char *const sorted[] = { "B", "G", "R", "Z" };
    static const struct image_text texts[] = {
        { "firn/settings", "ior = 1.31\n\"quoted\"" },
        { "comments", "" },
        { "firn/a-name-longer-than-thirty-one-characters", "x" },
    };
    static const float camera[16] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16 };
    static const float ndc[16] = { -1, 0.5f, 3e-20f };
    const struct exr_header header = { texts, 3, camera, ndc };
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t context = NULL;
    exr_attr_chromaticities_t colours;
    exr_compression_t compression;
    const exr_attr_chlist_t *channels;
    struct image image = { 0 };
    (void)state;
    make_image(&image, 5, 3, names, 4);
    struct bytes bytes = encode(&image, &header);
    start.user_data = &bytes;
    start.read_fn = read_memory;
    assert_int_equal(exr_start_read(&context, "memory", &start), 0);
    check_texts(context, &header);
    check_matrix(context, "worldToCamera", camera);
    check_matrix(context, "worldToNDC", ndc);
    assert_int_equal(exr_attr_get_chromaticities(context, 0, "chromaticities", &colours), 0);
    CHECK_NEAR(colours.red_x, 0.64, 1e-6);
    CHECK_NEAR(colours.green_y, 0.6, 1e-6);
    CHECK_NEAR(colours.blue_x, 0.15, 1e-6);
    CHECK_NEAR(colours.white_x, 0.3127, 1e-6);
    CHECK_NEAR(colours.white_y, 0.329, 1e-6);
    assert_int_equal(exr_get_compression(context, 0, &compression), 0);
    assert_int_equal(compression, EXR_COMPRESSION_ZIP);
    assert_int_equal(exr_get_channels(context, 0, &channels), 0);
    assert_int_equal(channels->num_channels, 4);
    for (int c = 0; c < 4; c++)
        assert_string_equal(channels->entries[c].name.str, sorted[c]);
    exr_finish(&context);
    free(bytes.data);
    image_finish(&image);
}

static void test_same_bytes_twice(void **state)
{
    static const char *const names[] = { "R", "G", "B" };
    static const struct image_text texts[] = { { "firn/settings", "a" } };
    const struct exr_header header = { .texts = texts, .text_count = 1 };
    struct image image = { 0 };
    (void)state;
    make_image(&image, 33, 40, names, 3);
    const struct bytes a = encode(&image, &header);
    const struct bytes b = encode(&image, &header);
    assert_int_equal(a.size, b.size);
    assert_memory_equal(a.data, b.data, a.size);
    free(a.data);
    free(b.data);
    image_finish(&image);
}

static void test_refused_header(void **state)
{
    static const char *const names[] = { "R" };
    static const struct image_text texts[] = { { "channels", "of another type" } };
    const struct exr_header header = { .texts = texts, .text_count = 1 };
    struct image image = { 0 };
    void *data = &image;
    size_t size = 1;

    (void)state;
    make_image(&image, 4, 4, names, 1);
    assert_int_equal(exr_encode(&image, &header, &data, &size), STATUS_FAILED);
    assert_null(data);
    image_finish(&image);
}

/* -- damage -- */

static struct bytes encode_small(void)
{
    static const char *const names[] = { "R", "G", "B", "N.X" };
    struct image image = { 0 };
    make_image(&image, 19, 37, names, 4);
    const struct bytes bytes = encode(&image, &plain_header);
    image_finish(&image);
    return bytes;
}

static void test_no_input(void **state)
{
    struct image image = { 0 };
    (void)state;
    assert_int_equal(read_image("/nonexistent/a.exr", &image), STATUS_NO_INPUT);
    check_empty(&image);
    assert_int_equal(read_image("/", &image), STATUS_NO_INPUT);
    check_empty(&image);
}

static void test_truncated(void **state)
{
    const struct bytes bytes = encode_small();
    (void)state;
    for (size_t size = 0; size < bytes.size; size += 37)
        check_refused(bytes.data, size);
    check_refused(bytes.data, bytes.size - 1);
    free(bytes.data);
}

static void test_missing_chunk(void **state)
{
    const struct bytes bytes = encode_small();
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t context = NULL;
    exr_chunk_info_t chunk;
    struct bytes copy = bytes;
    bool found = false;

    (void)state;
    start.user_data = &copy;
    start.read_fn = read_memory;
    assert_int_equal(exr_start_read(&context, "memory", &start), 0);
    assert_int_equal(exr_read_scanline_chunk_info(context, 0, 16, &chunk), 0);
    exr_finish(&context);
    /* chunks begin with line number and size, and the table names that place */
    const uint64_t place = chunk.data_offset - 8;
    for (size_t i = 0; i + 8 <= bytes.size && !found; i++) {
        found = memcmp((const char *)bytes.data + i, &place, 8) == 0;
        if (found)
            memset((char *)bytes.data + i, 0, 8);
    }
    assert_true(found);
    check_refused(bytes.data, bytes.size);
    free(bytes.data);
}

/* Whatever comes out, it is one of the promised ends and nothing is lost (under sanitizers). */
static void test_bit_flips(void **state)
{
    const struct bytes bytes = encode_small();
    unsigned char *damaged = malloc(bytes.size);
    uint32_t seed = 7, refused = 0;

    (void)state;
    for (int round = 0; round < 300; round++) {
        struct image image = { 0 };
        memcpy(damaged, bytes.data, bytes.size);
        for (int flip = 0; flip < 1 + round % 4; flip++) {
            seed = seed * 1664525u + 1013904223u;
            damaged[(seed >> 3) % (round % 2 ? bytes.size : 400)] ^= (unsigned char)(1 << seed % 8);
        }
        const enum status status = read_bytes(damaged, bytes.size, &image);
        assert_true(status == STATUS_OK || status == STATUS_DATA || status == STATUS_TRY_AGAIN);
        if (status == STATUS_OK)
            image_finish(&image);
        else
            refused++;
        check_empty(&image);
    }
    assert_true(refused > 100);
    free(damaged);
    free(bytes.data);
}

static const struct image_text matching_texts[] = {
    { "firn/version", "1" },
    { "firn/settings", "a=1 b=2" },
    { "firn/device", "any" },
};
static const char *const matching_names[] = { "R", "G", "B" };

/* Saves a small picture with these texts, and leaves its form. */
static struct bytes save_matching(struct image *image)
{
    const struct exr_header header = { .texts = matching_texts, .text_count = 3 };
    make_image(image, 19, 37, matching_names, 3);
    const struct bytes bytes = encode(image, &header);
    save(bytes.data, bytes.size);
    return bytes;
}

/* Whether the file is whole and has this form. */
static bool file_matches(const struct image *image, const struct exr_header *header)
{
    struct image_header head;
    const bool matches = exr_check(path, &head) == STATUS_OK && exr_matches(&head, image, header);
    image_header_finish(&head);
    return matches;
}

static void test_matches_form(void **state)
{
    const struct exr_header header = { .texts = matching_texts, .text_count = 2 };
    struct image image = { 0 };
    (void)state;
    free(save_matching(&image).data);
    assert_true(file_matches(&image, &header));
    for (int i = 0; i < 3; i++) {
        uint32_t *field = i == 0 ? &image.width : i == 1 ? &image.height : &image.plane_count;
        (*field)--;
        assert_false(file_matches(&image, &header));
        (*field)++;
    }
    image.planes[1].half = true;
    assert_false(file_matches(&image, &header));
    image.planes[1].half = false;
    image.planes[1].name[0] = 'A';
    assert_false(file_matches(&image, &header));
    image.planes[1].name[0] = 'G';
    assert_true(file_matches(&image, &header));
    image_finish(&image);
}

/* Where a file's pixels are in a larger picture, written and found again. */
static void test_place(void **state)
{
    (void)state;
    static const char *const names[] = { "R", "N.X" };
    const struct exr_header header = { .window = { 6, 20, 100, 50 } };
    const struct exr_header others[] = { { .window = { 8, 20, 100, 50 } },
                                         { .window = { 6, 20, 100, 51 } },
                                         { .window = { 0 } } };
    struct image image, read = { 0 };
    struct image_header head;
    make_image(&image, 37, 30, names, 2);
    const struct bytes bytes = encode(&image, &header);
    save(bytes.data, bytes.size);
    free(bytes.data);
    assert_int_equal(read_image(path, &read), STATUS_OK);
    check_same(&image, &read);
    image_finish(&read);
    assert_int_equal(exr_check(path, &head), STATUS_OK);
    assert_true(head.has_window);
    assert_memory_equal(&head.window, &header.window, sizeof(head.window));
    image_header_finish(&head);
    assert_true(file_matches(&image, &header));
    for (size_t i = 0; i < 3; i++)
        assert_false(file_matches(&image, &others[i]));
    image_finish(&image);
}

static void test_matches_texts(void **state)
{
    static const struct image_text others[] = {
        { "firn/settings", "a=1 b=3" }, { "firn/settings", "a=1 b=" }, { "firn/version", "1 " },
        { "firn/settings", "" },        { "firn/else", "1" },          { "channels", "R" },
    };
    struct exr_header header = { .text_count = 1 };
    struct image image = { 0 };
    (void)state;
    free(save_matching(&image).data);
    for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); i++) {
        header.texts = &others[i];
        assert_false(file_matches(&image, &header));
    }
    header.texts = &matching_texts[1];
    assert_true(file_matches(&image, &header));
    image_finish(&image);
}

static void test_matches_whole_files(void **state)
{
    const struct exr_header header = { .texts = matching_texts, .text_count = 2 };
    struct image image = { 0 };
    const struct bytes bytes = save_matching(&image);

    (void)state;
    for (size_t size = 0; size < bytes.size; size += 37) {
        save(bytes.data, size);
        assert_false(file_matches(&image, &header));
    }
    save(bytes.data, bytes.size - 1);
    assert_false(file_matches(&image, &header));
    save(bytes.data, bytes.size);
    assert_true(file_matches(&image, &header));
    image_finish(&image);
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
        cmocka_unit_test(test_round_trips),
        cmocka_unit_test(test_long_names),
        cmocka_unit_test(test_special_values),
        cmocka_unit_test(test_integers),
        cmocka_unit_test(test_cryptomatte),
        cmocka_unit_test(test_packed_as_long_as_unpacked),
        cmocka_unit_test(test_incompressible),
        cmocka_unit_test(test_header),
        cmocka_unit_test(test_same_bytes_twice),
        cmocka_unit_test(test_refused_header),
        cmocka_unit_test(test_no_input),
        cmocka_unit_test(test_truncated),
        cmocka_unit_test(test_missing_chunk),
        cmocka_unit_test(test_bit_flips),
        cmocka_unit_test(test_matches_form),
        cmocka_unit_test(test_matches_texts),
        cmocka_unit_test(test_place),
        cmocka_unit_test(test_matches_whole_files),
    };
    if (close(mkstemp(path)) != 0)
        return 1;
    return cmocka_run_group_tests(tests, NULL, remove_file);
}
