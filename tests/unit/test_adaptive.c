/* test_adaptive.c: adaptive sampling: selection of noisy cells and sample counts. */
#include "src/render/adaptive_sampling.h"

#include <stdlib.h>
#include <string.h>

#include "src/file/half_float.h"
#include "tests/support/assertions.h"

enum {
    CELL = ADAPTIVE_CELL,
    WIDTH = 20 * CELL + 5, /* cells at the edges are smaller */
    HEIGHT = 8 * CELL + 1,
};

static const struct rg_image half_rgba = { "half", VK_FORMAT_R16G16B16A16_SFLOAT };

/* Brightness .5, but for some cells, where it is by turns `low` and 1 - `low` up to `end`. */
struct noise {
    struct tile cells;
    float low;
    uint32_t end;
};

static float value_at(const struct noise *noise, uint32_t x, uint32_t y, uint32_t sample)
{
    const struct tile *cells = &noise->cells;
    const bool is_noisy = x / CELL - cells->x < cells->width && y / CELL - cells->y < cells->height;
    if (!is_noisy || sample >= noise->end)
        return 0.5f;
    return sample % 2 ? noise->low : 1.0f - noise->low;
}

static void add_sample(struct adaptive *a, const struct noise *noise, uint32_t sample)
{
    uint16_t *texels = malloc((size_t)WIDTH * HEIGHT * 4 * sizeof(*texels));
    assert_non_null(texels);
    for (uint32_t p = 0; p < a->rectangle_count; p++) {
        const struct tile *part = &a->rectangles[p];
        for (uint32_t i = 0; i < part->width * part->height; i++) {
            const float value =
                value_at(noise, part->x + i % part->width, part->y + i / part->width, sample);
            for (uint32_t c = 0; c < 4; c++)
                texels[4 * i + c] = half_from_float(value);
        }
        adaptive_add(a, part, texels, sample);
    }
    free(texels);
}

/* Draws until no cell goes on. Returns how many samples that takes where it takes most. */
static uint32_t draw(struct adaptive *a, const struct noise *noise)
{
    uint32_t done = 0;
    assert_true(adaptive_init(a, WIDTH, HEIGHT));
    do {
        for (; done < a->end; done++)
            add_sample(a, noise, done);
    } while (adaptive_next_round(a));
    return done;
}

static uint32_t samples_at(const struct adaptive *a, uint32_t column, uint32_t row)
{
    return a->counts[row * a->columns + column];
}

static void test_an_even_picture(void **state)
{
    (void)state;
    const struct noise none = { .low = 0.5f };
    struct adaptive a;
    assert_int_equal(draw(&a, &none), 4);
    CHECK_NEAR(adaptive_mean(&a), 4.0f, 0.0);
    adaptive_finish(&a);
}

static void test_noise_everywhere(void **state)
{
    (void)state;
    const struct noise noise = { { 0, 0, 21, 9 }, 0.25f, 64 };
    struct adaptive a;
    assert_int_equal(draw(&a, &noise), 64);
    CHECK_NEAR(adaptive_mean(&a), 64.0f, 0.0);
    adaptive_finish(&a);
}

/* Cells far apart are parts of their own, at the smaller edges, too; the rest has 4 samples. */
static void test_noise_in_corners(void **state)
{
    (void)state;
    const struct noise corners[] = { { { 0, 0, 2, 1 }, 0.25f, 64 },
                                     { { 20, 8, 1, 1 }, 0.25f, 64 } };
    for (uint32_t i = 0; i < 2; i++) {
        struct adaptive a;
        assert_int_equal(draw(&a, &corners[i]), 64);
        for (uint32_t row = 0; row < a.rows; row++) {
            for (uint32_t column = 0; column < a.columns; column++) {
                const bool is_noisy = i ? column == 20 && row == 8 : column < 2 && row == 0;
                assert_int_equal(samples_at(&a, column, row), is_noisy ? 64 : 4);
            }
        }
        adaptive_finish(&a);
    }
}

/* Two far corners are two parts; near cells share one. */
static void test_parts(void **state)
{
    (void)state;
    struct adaptive a;
    assert_true(adaptive_init(&a, WIDTH, HEIGHT));
    const struct noise first = { { 0, 0, 1, 1 }, 0.25f, 64 };
    for (uint32_t i = 0; i < 4; i++)
        add_sample(&a, &first, i);
    a.alternate_sums[(size_t)WIDTH * HEIGHT - 1] = 10.0f; /* the last pixel, a cell of 5 alone */
    assert_true(adaptive_next_round(&a));
    assert_int_equal(a.rectangle_count, 2);
    assert_int_equal(a.rectangles[0].width, CELL);
    assert_int_equal(a.rectangles[1].x, 20 * CELL);
    assert_int_equal(a.rectangles[1].width, 5);
    assert_int_equal(a.rectangles[1].height, 1);
    adaptive_finish(&a);
}

/* Of samples .5 + d and .5 - d in turns the error is d; of four and twelve of .5 a quarter. */
static void test_the_limit(void **state)
{
    (void)state;
    const float above = (float)(ADAPTIVE_NOISE * 1.05), below = (float)(ADAPTIVE_NOISE * 0.95);
    const struct noise noisy = { { 3, 3, 1, 1 }, 0.5f - above, 4 };
    const struct noise quiet = { { 3, 3, 1, 1 }, 0.5f - below, 4 };
    struct adaptive a;
    assert_int_equal(draw(&a, &noisy), 16);
    adaptive_finish(&a);
    assert_int_equal(draw(&a, &quiet), 4);
    adaptive_finish(&a);
}

/* Sums of fewer samples become those of 64 that have the same mean. */
static void test_evened_sums(void **state)
{
    (void)state;
    const struct noise noise = { { 1, 0, 1, 1 }, 0.25f, 64 };
    const struct frame_layer layer = { .image = &half_rgba, .planes = { "a" }, .mean = true };
    const struct frame_layer centre = { .image = &half_rgba, .planes = { "b" } };
    struct adaptive a;
    struct image image;
    draw(&a, &noise);
    image_init(&image, WIDTH, HEIGHT);
    assert_non_null(image_add_plane(&image, "a", true));
    assert_non_null(image_add_plane(&image, "b", true));
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        image_find(&image, "a")[i] = image_find(&image, "b")[i] = 1.0f;
    adaptive_rescale(&a, &image, &layer);
    adaptive_rescale(&a, &image, &centre);
    CHECK_NEAR(image_find(&image, "a")[0], 16.0f, 0.0);
    CHECK_NEAR(image_find(&image, "a")[CELL], 1.0f, 0.0);
    CHECK_NEAR(image_find(&image, "b")[0], 1.0f, 0.0);
    image_finish(&image);
    adaptive_finish(&a);
}

/* Each of the first 4 samples has its own light maps; then each doubling of the samples has one. */
static void test_light_maps(void **state)
{
    static const uint32_t first[] = { 0, 1, 2, 3, 4, 8, 16, 32 };
    uint32_t count = 0;
    (void)state;
    for (uint32_t sample = 0; sample < ADAPTIVE_SAMPLES; sample++) {
        count += count < 8 && sample == first[count];
        assert_int_equal(adaptive_light_sample(sample), first[count - 1]);
    }
    assert_int_equal(count, 8);
}

static void test_even_light_maps(void **state)
{
    static const uint32_t expected[] = { 0, 0, 0, 3, 3, 3, 6, 6, 6, 9 };
    (void)state;
    for (uint32_t sample = 0; sample < 10; sample++)
        assert_int_equal(even_light_sample(sample), expected[sample]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_light_maps),       cmocka_unit_test(test_even_light_maps),
        cmocka_unit_test(test_an_even_picture),  cmocka_unit_test(test_noise_everywhere),
        cmocka_unit_test(test_noise_in_corners), cmocka_unit_test(test_parts),
        cmocka_unit_test(test_the_limit),        cmocka_unit_test(test_evened_sums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
