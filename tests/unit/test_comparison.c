/* test_comparison.c: comparison of two images, layer by layer. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/metric/flip_color.h"
#include "src/lab/metric/heat_map.h"
#include "src/lab/metric/layer_comparison.h"
#include "src/lab/metric/quantile.h"
#include "tests/support/assertions.h"

static void test_order(void **state)
{
    float values[] = { 5, -1, 3, 2, 4 };

    (void)state;
    quantile_sort(values, 5);
    for (int i = 0; i < 4; i++)
        assert_true(values[i] < values[i + 1]);
    CHECK_NEAR(quantile_median(values, 5), 3, 0);
    CHECK_NEAR(quantile_median(values, 4), 2.5, 0);
    CHECK_NEAR(quantile_median(values, 1), -1, 0);
    CHECK_NEAR(quantile_at(values, 5, 0.0), -1, 0);
    CHECK_NEAR(quantile_at(values, 5, 0.6), 3, 0);
    CHECK_NEAR(quantile_at(values, 5, 0.61), 4, 0);
    CHECK_NEAR(quantile_at(values, 5, 1.0), 5, 0);
}

static void test_difference(void **state)
{
    const float reference[] = { 0, 1, -2, NAN, 1, 7 }, test[] = { 3, 1, 2, 1, INFINITY, 0 };
    const bool counted[] = { true, true, true, true, true, false };
    struct difference d = { 0 };

    (void)state;
    assert_true(isnan(difference_rmse(&d)) && isnan(difference_relmse(&d)) &&
                isnan(difference_mae(&d)) && isnan(difference_mae_unclipped(&d)));
    difference_add(&d, reference, test, counted, 6);
    assert_int_equal(d.count, 3);
    assert_int_equal(d.not_finite, 2);
    CHECK_NEAR(difference_rmse(&d), sqrt(25 / 3.0), 1e-12);
    CHECK_NEAR(difference_relmse(&d), (9 / 0.01 + 16 / 4.01) / 3, 1e-9);
    CHECK_NEAR(difference_mae(&d), 2 / 3.0, 1e-12); /* 0, 1, -2 to 3, 1, 2 */
    CHECK_NEAR(difference_mae_unclipped(&d), 7 / 3.0, 1e-12);
    CHECK_NEAR(d.largest, 4, 0);
    difference_add(&d, reference, test, NULL, 6);
    assert_int_equal(d.count, 7);
    CHECK_NEAR(d.largest, 7, 0);
}

static void test_angle(void **state)
{
    /* 90 degrees, 180, 1e-3, none in one, none in both; the last does not count */
    const float small = 1.7453293e-5f;
    const float rx[] = { 1, 1, 0, 1, 0, 1 }, ry[6] = { 0 }, rz[] = { 0, 0, 1, 0, 0, 0 };
    const float tx[] = { 0, -2, small, 0, 0, 0 }, ty[] = { 1, 0, 0, 0, 0, 1 };
    const float tz[] = { 0, 0, 1, 0.4f, NAN, 0 };
    const bool counted[] = { true, true, true, true, true, false };
    const struct angle_pair pair = { { rx, ry, rz }, { tx, ty, tz }, counted, 6 };
    struct angle angle;
    float degrees[6];

    (void)state;
    assert_true(angle_measure(&angle, &pair, degrees));
    assert_int_equal(angle.both, 3);
    assert_int_equal(angle.only_reference, 1);
    assert_int_equal(angle.only_test, 0);
    CHECK_NEAR(angle.mean, 270.001 / 3, 1e-5);
    CHECK_NEAR(angle.median, 90, 1e-5);
    CHECK_NEAR(angle.percentile_95, 180, 1e-5);
    CHECK_NEAR(angle.largest, 180, 1e-5);
    CHECK_NEAR(degrees[2], 1e-3, 1e-8);
    CHECK_NEAR(degrees[3], 0, 0);
    CHECK_NEAR(degrees[5], 0, 0);

    const struct angle_pair none = { { ry, ry, ry }, { tx, ty, tz }, NULL, 6 };
    assert_true(angle_measure(&angle, &none, NULL));
    assert_int_equal(angle.both, 0);
    assert_int_equal(angle.only_test, 4);
    assert_true(isnan(angle.mean) && isnan(angle.median));
}

/* Each step of errors is as much lighter as any other. */
static void test_heat(void **state)
{
    uint8_t rgb[3], beyond[3];

    (void)state;
    for (int i = 0; i <= 64; i++) {
        vec3s v;
        heat_map_srgb((float)i / 64.0f, rgb);
        for (int c = 0; c < 3; c++) {
            const float x = (float)rgb[c] / 255.0f;
            v.raw[c] = x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
        }
        CHECK_NEAR(flip_color_hunt(v).x, 2 + 95 * i / 64.0, 1.5);
    }
    heat_map_srgb(7.0f, beyond);
    assert_memory_equal(beyond, rgb, 3);
    heat_map_srgb(0.0f, rgb);
    heat_map_srgb(-1.0f, beyond);
    assert_memory_equal(beyond, rgb, 3);
}

/* ---- comparisons ---- */

enum {
    SIDE = 4,
    COUNT = SIDE * SIDE
};

static void make_image(struct image *image, const char *const *names, float value)
{
    image_init(image, SIDE, SIDE);
    for (; *names; names++) {
        float *texels = image_add_plane(image, *names, false);
        assert_non_null(texels);
        for (size_t i = 0; i < COUNT; i++)
            texels[i] = value;
    }
}

static const struct comparison_params plain = { .ppd = FLIP_PPD, .display = true };

static struct comparison compare(const struct comparison_params *how, const struct image *reference,
                                 const struct image *test)
{
    struct comparison_params params = *how;
    struct comparison c;
    params.reference = reference;
    params.test = test;
    assert_true(comparison_init(&c, &params));
    return c;
}

static void test_layers(void **state)
{
    static const char *const ours[] = {
        "A", "B", "G", "R", ".x", "a.b.X", "a.b.Y", "a.c", "Z", NULL
    };
    static const char *const others[] = { "Z", "R", "G", "B", ".x", "a.b.X", "a.c", "N.X", NULL };
    static const char *const layers[] = { "beauty", ".x", "a.b", "a", "Z" };
    struct image a, b;

    (void)state;
    make_image(&a, ours, 0.5f);
    make_image(&b, others, 0.5f);
    struct comparison c = compare(&plain, &a, &b);
    assert_int_equal(c.counted, COUNT);
    assert_int_equal(c.layer_count, 5);
    for (size_t i = 0; i < 5; i++)
        assert_string_equal(c.layers[i].name, layers[i]);
    assert_int_equal(comparison_find(&c, "beauty")->difference.count, 3 * COUNT);
    assert_int_equal(comparison_find(&c, "a.b")->difference.count, COUNT);
    assert_null(comparison_find(&c, "N"));
    assert_int_equal(c.only_reference_count, 2);
    assert_string_equal(c.only_reference[0], "A");
    assert_string_equal(c.only_reference[1], "a.b.Y");
    assert_int_equal(c.only_test_count, 1);
    assert_string_equal(c.only_test[0], "N.X");
    comparison_finish(&c);
    assert_null(c.errors);
    image_finish(&a);
    image_finish(&b);
}

/* Without all three of them there is no beauty. */
static void test_one_color(void **state)
{
    static const char *const red[] = { "R", NULL };
    static const char *const three[] = { "R", "G", "B", NULL };
    struct image a, b;
    double value;

    (void)state;
    make_image(&a, red, 0.5f);
    make_image(&b, three, 0.25f);
    struct comparison c = compare(&plain, &a, &b);
    assert_false(c.has_beauty);
    assert_string_equal(c.layers[0].name, "R");
    CHECK_NEAR(difference_rmse(&c.layers[0].difference), 0.25, 1e-9);
    for (int i = 0; i < COMPARISON_METRIC_COUNT; i++)
        assert_null(comparison_metric(&c, (enum comparison_metric)i, &value));
    comparison_finish(&c);
    image_finish(&a);
    image_finish(&b);
}

static void test_metrics(void **state)
{
    static const char *const names[] = { "R", "G", "B", "exit.X", "exit.Y", "exit.Z", NULL };
    struct comparison_params params = plain;
    bool counted[COUNT] = { [3] = true, [5] = true };
    struct image a, b;
    double values[COMPARISON_METRIC_COUNT];

    (void)state;
    make_image(&a, names, 0.5f);
    make_image(&b, names, 0.5f);
    image_find(&b, "G")[3] = 0.8f;
    image_find(&b, "G")[4] = 100.0f; /* does not count */
    image_find(&b, "exit.X")[5] = -0.5f;
    params.counted = counted;
    struct comparison c = compare(&params, &a, &b);
    assert_int_equal(c.counted, 2);
    for (int i = 0; i < COMPARISON_METRIC_COUNT; i++)
        assert_non_null(comparison_metric(&c, (enum comparison_metric)i, &values[i]));
    CHECK_NEAR(values[COMPARISON_FLIP], (c.errors[3] + c.errors[5]) / 2, 1e-7);
    assert_true(c.errors[3] > 0.1f);
    CHECK_NEAR(c.errors[4], 0, 0);
    CHECK_NEAR(values[COMPARISON_RMSE], sqrt(0.09 / 6), 1e-7);
    CHECK_NEAR(values[COMPARISON_RELMSE], 0.09 / 0.26 / 6, 1e-7);
    CHECK_NEAR(values[COMPARISON_ANGLE], 70.528779 / 2, 1e-4); /* acos(1 / 3) */
    assert_false(c.is_hdr);
    comparison_finish(&c);
    params.display = false;
    c = compare(&params, &a, &b);
    assert_true(c.is_hdr);
    assert_int_equal(c.exposures.count, 2);
    comparison_finish(&c);
    params.has_exposure = true;
    c = compare(&params, &a, &b);
    assert_false(c.is_hdr);
    comparison_finish(&c);
    image_finish(&a);
    image_finish(&b);
}

/* Without exit all pixels count, with it those that have it in either. */
static void test_tir(void **state)
{
    static const char *const with[] = { "tir.Z", "exit.X", "exit.Y", "exit.Z", NULL };
    static const char *const without[] = { "tir.Z", NULL };

    (void)state;
    for (int i = 0; i < 2; i++) {
        struct image a, b;
        make_image(&a, i ? with : without, 0.0f);
        make_image(&b, with, 0.0f);
        image_find(&b, "tir.Z")[1] = 1.0f;
        image_find(&b, "tir.Z")[2] = NAN;
        image_find(&b, "exit.Z")[1] = 1.0f;
        image_find(i ? &a : &b, "exit.Z")[0] = 1.0f;
        struct comparison c = compare(&plain, &a, &b);
        assert_true(c.has_tir);
        assert_int_equal(c.tir_count, i ? 2 : COUNT);
        assert_int_equal(c.tir_differs, i ? 1 : 2);
        comparison_finish(&c);
        image_finish(&a);
        image_finish(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),   cmocka_unit_test(test_difference),
        cmocka_unit_test(test_angle),   cmocka_unit_test(test_heat),
        cmocka_unit_test(test_layers),  cmocka_unit_test(test_one_color),
        cmocka_unit_test(test_metrics), cmocka_unit_test(test_tir),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
