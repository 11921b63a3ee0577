/* test_weighted_mean.c: weighted means of samples antialias highlights. */
#include "src/render/weighted_mean.h"

#include "src/file/half_float.h"
#include "src/tech/output/tonemap.h"
#include "tests/support/assertions.h"

static const struct tile pixel = { .width = 1, .height = 1 };

/* Finds the mean of grey samples, and returns the variance of its brightness. A negative grey is an
 * empty sample, with alpha 0. */
static float find_mean(const float *greys, uint32_t count, float scale, float rgba[4])
{
    struct image image;
    image_init(&image, 1, 1);
    assert_true(weighted_mean_add_planes(&image));
    for (uint32_t i = 0; i < count; i++) {
        const uint16_t grey = half_from_float(greys[i] < 0.0f ? 0.0f : greys[i]);
        const uint16_t texels[4] = { grey, grey, grey, half_from_float(greys[i] < 0.0f ? 0 : 1) };
        weighted_mean_add(&image, &pixel, texels, scale);
    }
    weighted_mean_divide(&image, count, scale);
    for (uint32_t c = 0; c < 4; c++)
        rgba[c] = image_find(&image, frame_beauty.planes[c])[0];
    const float variance = image_find(&image, "variance")[0];
    image_finish(&image);
    return variance;
}

static float shown(const float *greys, uint32_t count, float scale)
{
    const struct tonemap_params params = { 1.0f, TONEMAP_NEUTRAL };
    float rgba[4];
    find_mean(greys, count, scale, rgba);
    return tonemap_encode((vec3s){ { rgba[0], rgba[1], rgba[2] } }, params).x;
}

static void edges_of_highlights_are_grey(void **state)
{
    static const float edge[] = { 0.0f, 50.0f, 0.0f, 50.0f, 0.0f, 0.0f, 0.0f, 0.0f };
    (void)state;
    assert_true(shown(&edge[2], 4, 0.0f) > 0.99f);
    assert_true(shown(&edge[2], 4, 1.0f) > 0.4f && shown(&edge[2], 4, 1.0f) < 0.8f);
    assert_true(shown(edge, 8, 1.0f) < 0.8f);
}

static void equal_samples_are_unchanged(void **state)
{
    static const float greys[] = { 3.0f, 3.0f, 3.0f };
    float rgba[4];
    (void)state;
    find_mean(greys, 3, 1.0f, rgba);
    CHECK_NEAR(rgba[1], 3.0f, 1e-6);
    CHECK_NEAR(rgba[3], 1.0f, 0.0);
}

static void weights_depend_on_exposure(void **state)
{
    static const float greys[] = { 0.0f, 1.0f };
    float rgba[4];
    (void)state;
    find_mean(greys, 2, 0.0f, rgba);
    CHECK_NEAR(rgba[0], 0.5f, 0.0);
    find_mean(greys, 2, 3.0f, rgba);
    CHECK_NEAR(rgba[0], 0.2f, 1e-6);
}

static void alpha_is_coverage(void **state)
{
    static const float greys[] = { 9.0f, -1.0f, -1.0f, -1.0f }, none[] = { -1.0f, -1.0f };
    float rgba[4];
    (void)state;
    find_mean(greys, 4, 1.0f, rgba);
    CHECK_NEAR(rgba[3], 0.25f, 0.0);
    CHECK_NEAR(rgba[0] / rgba[3], 9.0f, 1e-5);
    find_mean(none, 2, 1.0f, rgba);
    CHECK_NEAR(rgba[0], 0.0f, 0.0);
    CHECK_NEAR(rgba[3], 0.0f, 0.0);
}

/* Returns pixel `at` of an image of 3 x 3 pixels with another grey in the middle, filtered. */
static float filtered_grey(float grey, float middle, size_t at)
{
    struct image image;
    image_init(&image, 3, 3);
    assert_true(weighted_mean_add_planes(&image));
    for (size_t p = 0; p < 4; p++) {
        float *plane = image_find(&image, frame_beauty.planes[p]);
        for (size_t i = 0; i < 9; i++)
            plane[i] = p == 3 ? 1.0f : i == 4 ? middle : grey;
    }
    assert_true(weighted_mean_filter(&image, 1.0f));
    const float shown = image_find(&image, "G")[at];
    image_finish(&image);
    return shown;
}

static void filter_reaches_the_neighbours(void **state)
{
    const double centre = 0.668 * 0.668, side = 0.668 * 0.166, corner = 0.166 * 0.166;
    (void)state;
    for (size_t i = 0; i < 9; i++)
        CHECK_NEAR(filtered_grey(3.0f, 3.0f, i), 3.0, 1e-5);
    /* weights 1 / 10 of the middle, 1 of the others */
    CHECK_NEAR(filtered_grey(0.0f, 9.0f, 4), 0.9 * centre / (0.1 * centre + 1.0 - centre), 1e-5);
    CHECK_NEAR(filtered_grey(0.0f, 9.0f, 3), 0.9 * side / (0.1 * side + 1.0 - side), 1e-5);
    CHECK_NEAR(filtered_grey(0.0f, 9.0f, 8), 0.9 * corner / (0.1 * corner + 1.0 - corner), 1e-5);
}

static void variance_is_that_of_the_mean_brightness(void **state)
{
    static const float equal[] = { 3.0f, 3.0f, 3.0f }, edge[] = { 0.0f, 1.0f };
    float rgba[4];
    (void)state;
    CHECK_NEAR(find_mean(equal, 3, 1.0f, rgba), 0.0, 1e-6);
    CHECK_NEAR(find_mean(edge, 1, 1.0f, rgba), 0.0, 0.0);
    /* brightness 0 and sqrt(1/2): sample variance 1/4, of the mean of two 1/8 */
    CHECK_NEAR(find_mean(edge, 2, 1.0f, rgba), 0.125, 1e-6);
}

/* Filters 5 x 5 black pixels with a white centre, all of this variance; returns the centre. */
static float middle_of_noise(float variance)
{
    struct image image;
    image_init(&image, 5, 5);
    assert_true(weighted_mean_add_planes(&image));
    for (size_t i = 0; i < 25; i++) {
        image_find(&image, "A")[i] = 1.0f;
        image_find(&image, "variance")[i] = variance;
    }
    image_find(&image, "G")[12] = 1.0f;
    assert_true(weighted_mean_filter(&image, 1.0f));
    const float shown = image_find(&image, "G")[12];
    image_finish(&image);
    return shown;
}

static void noisy_pixels_are_averaged(void **state)
{
    const float sharp = middle_of_noise(0.0f);
    (void)state;
    CHECK_NEAR(middle_of_noise(3e-4f), sharp, 0.0); /* standard error 0.017 */
    const float soft = middle_of_noise(0.2f);
    assert_true(soft < 0.6f * sharp);
    assert_true(middle_of_noise(0.002f) > soft); /* noise explains less of the difference */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_of_highlights_are_grey),
        cmocka_unit_test(equal_samples_are_unchanged),
        cmocka_unit_test(weights_depend_on_exposure),
        cmocka_unit_test(alpha_is_coverage),
        cmocka_unit_test(filter_reaches_the_neighbours),
        cmocka_unit_test(variance_is_that_of_the_mean_brightness),
        cmocka_unit_test(noisy_pixels_are_averaged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
