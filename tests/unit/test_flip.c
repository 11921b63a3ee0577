/*
 * test_flip.c: each step of FLIP, against values computed by hand in double precision from the
 * papers' formulas; tests/support/flip.py computes whole images in the same way. The numbers are
 * the papers' formulas, worked out in double by hand; tests/support/flip.py has the same as a
 * program, for whole pictures.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "src/lab/metric/flip.h"
#include "src/lab/metric/flip_color.h"
#include "src/lab/metric/flip_filter.h"
#include "tests/support/assertions.h"

static void check_color(vec3s got, double x, double y, double z, double tolerance)
{
    CHECK_NEAR(got.x, x, tolerance);
    CHECK_NEAR(got.y, y, tolerance);
    CHECK_NEAR(got.z, z, tolerance);
}

static vec3s color(float x, float y, float z)
{
    return (vec3s){ { x, y, z } };
}

/* ---- colours ---- */

static void test_opponent(void **state)
{
    (void)state;
    check_color(flip_color_opponent(color(0, 0, 0)), -16, 0, 0, 1e-6);
    check_color(flip_color_opponent(color(1, 1, 1)), 100, 0, 0, 1e-4);
    check_color(flip_color_opponent(color(0.5f, 0.2f, 0.1f)), 13.762471, 27.304683, 27.705099,
                1e-4);
    for (int i = 0; i < 3; i++) {
        vec3s v = color(0.2f, 0.2f, 0.2f);
        v.raw[i] = 0.9f;
        check_color(flip_color_linear(flip_color_opponent(v)), (double)v.x, (double)v.y,
                    (double)v.z, 2e-6);
    }
    CHECK_NEAR(flip_color_luminance(-16), 0, 0);
    CHECK_NEAR(flip_color_luminance(42), 0.5, 1e-6);
}

static void test_hunt(void **state)
{
    (void)state;
    check_color(flip_color_hunt(color(0, 0, 0)), 0, 0, 0, 1e-5);
    check_color(flip_color_hunt(color(1, 1, 1)), 100, 0, 0, 1e-4);
    /* L*a*b* is 57.710324, 21.107744, 28.976233, and the last two fade to 0.57710324 */
    check_color(flip_color_hunt(color(0.5f, 0.2f, 0.1f)), 57.710324, 12.181347, 16.722278, 1e-4);
    /* below the cube root's (6/29)^3 */
    check_color(flip_color_hunt(color(0.001f, 0.002f, 0.003f)), 1.679719, -0.006774, -0.026042,
                1e-5);
}

static void test_distance(void **state)
{
    (void)state;
    CHECK_NEAR(flip_color_distance(color(50, 10, 20), color(30, 13, 16)), 20 + 5, 1e-5);
    CHECK_NEAR(flip_color_distance(color(30, 13, 16), color(50, 10, 20)), 20 + 5, 1e-5);
}

static void test_error(void **state)
{
    static const struct {
        float distance;
        double error;
    } samples[] = {
        { 0.0f, 0.0 },           { 1.0f, 0.057539353 }, { 10.0f, 0.288379892 },
        { 50.0f, 0.889700793 },  { 54.9104732f, 0.95 }, { 55.0f, 0.950038034 },
        { 100.0f, 0.967379861 }, { 203.301655f, 1.0 },  { 1000.0f, 1.0 },
    };

    const vec3s green = flip_color_hunt(color(0, 1, 0)), blue = flip_color_hunt(color(0, 0, 1));

    (void)state;
    for (size_t i = 0; i < sizeof(samples) / sizeof(samples[0]); i++)
        CHECK_NEAR(flip_color_error(samples[i].distance), samples[i].error, 1e-6);
    CHECK_NEAR(flip_color_distance(green, blue), 203.301655, 1e-3);
}

/* ---- filters ---- */

static double sum_of(const struct flip_kernel *kernel)
{
    double sum = 0.0;
    for (uint32_t i = 0; i <= 2 * kernel->radius; i++)
        sum += (double)kernel->weights[i];
    return sum;
}

/* Of the square filter, this far from its middle. */
static double weight_of(const struct flip_sensitivity *s, uint32_t x, uint32_t y)
{
    double weight = 0.0;
    for (uint32_t i = 0; i < s->count; i++) {
        const float *middle = s->kernels[i].weights + s->kernels[i].radius;
        weight += (double)(s->fractions[i] * middle[x] * middle[y]);
    }
    return weight;
}

static void test_sensitivity(void **state)
{
    static const struct {
        double ppd;
        uint32_t radius;
        double middle, beside, further; /* at 0, 0; 1, 0; 2, 1 */
    } wanted[][FLIP_CHANNEL_COUNT] = {
        {
            { 20, 3, 0.97933152, 0.0051401416, 3.9e-12 },
            { 20, 3, 0.96302061, 0.0091577548, 7.5e-11 },
            { 20, 3, 0.22443838, 0.1086146542, 0.0073825865 },
        },
        {
            { 67, 10, 0.14890264, 0.0932702545, 0.0143584042 },
            { 67, 10, 0.13204574, 0.0872096033, 0.0165929638 },
            { 67, 10, 0.02001285, 0.0187374648, 0.0144326107 },
        },
    };

    (void)state;
    for (size_t i = 0; i < 2; i++) {
        for (int c = 0; c < FLIP_CHANNEL_COUNT; c++) {
            struct flip_sensitivity s;
            flip_sensitivity_init(&s, (enum flip_channel)c, wanted[i][c].ppd);
            assert_int_equal(s.kernels[0].radius, wanted[i][c].radius);
            CHECK_NEAR(weight_of(&s, 0, 0), wanted[i][c].middle, 1e-7);
            CHECK_NEAR(weight_of(&s, 1, 0), wanted[i][c].beside, 1e-7);
            CHECK_NEAR(weight_of(&s, 2, 1), wanted[i][c].further, 1e-7);
            CHECK_NEAR(sum_of(&s.kernels[0]), 1, 1e-6);
        }
    }
}

static void test_features(void **state)
{
    struct flip_features f;

    (void)state;
    flip_features_init(&f, 67);
    assert_int_equal(f.edge.radius, 9);
    const float *edge = f.edge.weights + 9, *point = f.point.weights + 9;
    const float *smooth = f.smooth.weights + 9;
    CHECK_NEAR(edge[0] * smooth[0], 0, 1e-9);
    CHECK_NEAR(edge[-1] * smooth[0], 0.0182675135, 1e-8);
    CHECK_NEAR(edge[1] * smooth[1], -0.0170963343, 1e-8);
    CHECK_NEAR(edge[2] * smooth[0], -0.0299488484, 1e-8);
    CHECK_NEAR(point[0] * smooth[0], -0.0434418480, 1e-8);
    CHECK_NEAR(point[1] * smooth[0], -0.0352688368, 1e-8);
    CHECK_NEAR(point[0] * smooth[1], -0.0406566749, 1e-8);
    CHECK_NEAR(point[3] * smooth[1], 0.0043748644, 1e-8);
    CHECK_NEAR(sum_of(&f.smooth), 1, 1e-6);
    CHECK_NEAR(sum_of(&f.edge), 0, 1e-6);
    CHECK_NEAR(sum_of(&f.point), 0, 1e-6);
}

static void test_every_ppd_fits(void **state)
{
    (void)state;
    for (int half = 2; half <= 2 * FLIP_PPD_MAX; half++) {
        const double ppd = half / 2.0;
        struct flip_sensitivity s;
        struct flip_features f;
        flip_sensitivity_init(&s, FLIP_BLUE_YELLOW, ppd);
        flip_features_init(&f, ppd);
        CHECK_NEAR(s.fractions[0] + s.fractions[1], 1, 1e-6);
        CHECK_NEAR(sum_of(&s.kernels[1]), 1, 1e-6);
        CHECK_NEAR(sum_of(&f.edge), 0, 1e-6);
        CHECK_NEAR(sum_of(&f.point), 0, 1e-6);
    }
}

enum {
    WIDTH = 19,
    HEIGHT = 5
};

static struct flip_plane make_plane(void)
{
    const size_t stride = flip_stride(WIDTH);
    float *texels = calloc(stride * HEIGHT, sizeof(*texels));
    assert_non_null(texels);
    return (struct flip_plane){ WIDTH, HEIGHT, stride, texels };
}

/* The least filters that tell left from right and up from down: each texel of the result is
 * 1 * left + 10 * itself + 100 * right, of rows weighed alike. */
static void test_filter_reaches_where_it_should(void **state)
{
    const struct flip_kernel across = { 1, { 1, 10, 100 } }, down = { 1, { 1000, 2000, 4000 } };
    struct flip_plane in = make_plane(), scratch = make_plane(), out = make_plane();
    float *line = calloc(flip_line_size(WIDTH), sizeof(*line));

    (void)state;
    in.texels[1 * in.stride + 3] = 1;         /* in the middle */
    in.texels[3 * in.stride + WIDTH - 1] = 1; /* at the border, beyond which it goes on */
    struct flip_filter filter = { &in, &across, &down, &scratch, &out, line, 0.5f, false };
    flip_filter(&filter);

    static const struct {
        uint32_t x, y;
        double value;
    } wanted[] = {
        { 2, 1, 100 * 2000 },  { 3, 1, 10 * 2000 },   { 4, 1, 1 * 2000 },    { 3, 0, 10 * 4000 },
        { 3, 2, 10 * 1000 },   { 5, 1, 0 },           { 3, 3, 0 },           { 17, 3, 100 * 2000 },
        { 18, 3, 110 * 2000 }, { 18, 4, 110 * 1000 }, { 18, 2, 110 * 4000 },
    };

    for (size_t i = 0; i < sizeof(wanted) / sizeof(wanted[0]); i++)
        CHECK_NEAR(out.texels[wanted[i].y * out.stride + wanted[i].x], 0.5 * wanted[i].value, 0);
    filter.add = true;
    flip_filter(&filter);
    CHECK_NEAR(out.texels[1 * out.stride + 3], 10 * 2000, 0);
    free(in.texels);
    free(scratch.texels);
    free(out.texels);
    free(line);
}

/* ---- exposures ---- */

static void test_tone(void **state)
{
    static const struct {
        double at_a_tenth, at_a_half, at_1, at_5, inverse;
    } wanted[FLIP_CURVE_COUNT] = {
        [FLIP_ACES] = { 0.05884397, 0.43849169, 0.67329047, 0.95374264, 2.11887232 },
        [FLIP_HABLE] = { 0.07421470, 0.30430056, 0.49291855, 0.97391543, 3.12776178 },
        [FLIP_REINHARD] = { 1 / 11.0, 1 / 3.0, 1 / 2.0, 5 / 6.0, 0.85 / 0.15 },
    };

    (void)state;
    for (int i = 0; i < FLIP_CURVE_COUNT; i++) {
        const enum flip_curve curve = (enum flip_curve)i;
        CHECK_NEAR(flip_tone(curve, color(0.1f, 0.1f, 0.1f)).x, wanted[i].at_a_tenth, 1e-6);
        CHECK_NEAR(flip_tone(curve, color(0.5f, 0.5f, 0.5f)).y, wanted[i].at_a_half, 1e-6);
        CHECK_NEAR(flip_tone(curve, color(1, 1, 1)).z, wanted[i].at_1, 1e-6);
        CHECK_NEAR(flip_tone(curve, color(5, 5, 5)).x, wanted[i].at_5, 1e-6);
        CHECK_NEAR(flip_tone(curve, color(0, 0, 0)).x, 0, 1e-9);
        assert_true(flip_tone(curve, color(1e15f, 1e15f, 1e15f)).y <= 1.0f);
        CHECK_NEAR(flip_tone_inverse(curve, 0.85), wanted[i].inverse, 1e-8);
    }
    /* by the luminance of all three, 0.83596 */
    check_color(flip_tone(FLIP_REINHARD, color(0.5f, 1, 0.2f)), 0.27234005, 0.54468011, 0.10893602,
                1e-6);
}

static void test_exposures(void **state)
{
    const double bright = 2.1188723; /* of ACES */

    (void)state;
    struct flip_exposures e = flip_tone_exposures(FLIP_ACES, bright * 8, bright / 5);
    CHECK_NEAR(e.first, -3, 1e-6);
    CHECK_NEAR(e.last, 2.3219281, 1e-6);
    assert_int_equal(e.count, 6); /* 5.32 stops, rounded up */
    e = flip_tone_exposures(FLIP_ACES, bright, bright);
    assert_int_equal(e.count, 2);
    e = flip_tone_exposures(FLIP_ACES, 0, 0);
    CHECK_NEAR(e.first, 0, 0);
    CHECK_NEAR(e.last, 0, 0);
    assert_int_equal(e.count, 2);
}

/* ---- whole pictures ---- */

enum {
    SIDE = 40,
    COUNT = SIDE * SIDE
};

struct pictures {
    float texels[6][COUNT]; /* R, G, B of the reference and the test */
    float errors[COUNT];
};

static struct pictures *make_pictures(float reference, float test)
{
    struct pictures *p = malloc(sizeof(*p));
    assert_non_null(p);
    for (size_t i = 0; i < COUNT; i++) {
        for (size_t c = 0; c < 6; c++)
            p->texels[c][i] = c < 3 ? reference : test;
    }
    return p;
}

static struct flip_pair pair_of(struct pictures *p)
{
    return (struct flip_pair){
        .width = SIDE,
        .height = SIDE,
        .reference = { p->texels[0], p->texels[1], p->texels[2] },
        .test = { p->texels[3], p->texels[4], p->texels[5] },
        .ppd = FLIP_PPD,
    };
}

/* Colours alone tell: of black and grey, |L* - 0|. */
static void test_flat(void **state)
{
    struct pictures *p = make_pictures(0.0f, 0.25f);
    const struct flip_pair pair = pair_of(p);
    const double distance = 116 * cbrt(0.25) - 16; /* L* */
    const double error = 0.95 + 0.05 * (pow(distance, 0.7) - 16.5104394) / 24.7656590;

    (void)state;
    assert_true(flip_ldr(&pair, 0.0, p->errors));
    for (size_t i = 0; i < COUNT; i++)
        CHECK_NEAR(p->errors[i], error, 1e-4);
    assert_true(flip_ldr(&pair, 2.0, p->errors)); /* 0.25 becomes 1, L* 100 */
    CHECK_NEAR(p->errors[0], 0.96737985, 1e-4);
    assert_true(flip_ldr(&pair, 30.0, p->errors)); /* and stays it */
    CHECK_NEAR(p->errors[0], 0.96737985, 1e-4);
    free(p);
}

static void test_same(void **state)
{
    struct pictures *p = make_pictures(0.0f, 0.0f);
    const struct flip_pair pair = pair_of(p);
    struct flip_exposures exposures;

    (void)state;
    for (size_t i = 0; i < COUNT; i++) {
        for (size_t c = 0; c < 6; c++)
            p->texels[c][i] = (float)(i * (c % 3 + 1) % 17) / 4.0f;
    }
    assert_true(flip_ldr(&pair, 0.0, p->errors));
    for (size_t i = 0; i < COUNT; i++)
        CHECK_NEAR(p->errors[i], 0, 0);
    assert_true(flip_hdr(&pair, FLIP_HABLE, p->errors, &exposures));
    for (size_t i = 0; i < COUNT; i++)
        CHECK_NEAR(p->errors[i], 0, 0);
    free(p);
}

/*
 * One texel brighter: a feature, so that the error there is more than its colour's, and nothing
 * where no filter reaches.
 */
static void test_feature_raises_error(void **state)
{
    struct pictures *p = make_pictures(0.25f, 0.25f);
    const struct flip_pair pair = pair_of(p);
    const size_t at = 20 * SIDE + 20;

    (void)state;
    for (size_t c = 3; c < 6; c++)
        p->texels[c][at] = 1.0f;
    assert_true(flip_ldr(&pair, 0.0, p->errors));
    /* 0.0434418 of a point each way, or 0.1489026 of Y's step of 87 to a grey of 0.361677 */
    const double colour = 0.95 / 16.5104394 * pow(116 * (cbrt(0.361677) - cbrt(0.25)), 0.7);
    const double feature = sqrt(0.0434418 * sqrt(2.0) * 0.75 / sqrt(2.0));
    CHECK_NEAR(p->errors[at], pow(colour, 1 - feature), 3e-3);
    CHECK_NEAR(p->errors[at + 11], 0, 1e-3);
    free(p);
}

static void test_not_finite_is_an_error(void **state)
{
    static const float values[3] = { NAN, INFINITY, -INFINITY };

    (void)state;
    for (size_t i = 0; i < 6; i++) {
        struct pictures *p = make_pictures(0.5f, 0.5f);
        const struct flip_pair pair = pair_of(p);
        struct flip_exposures exposures;
        p->texels[i][7] = values[i % 3];
        assert_true(flip_ldr(&pair, 0.0, p->errors));
        CHECK_NEAR(p->errors[7], 1, 0);
        CHECK_NEAR(p->errors[COUNT - 1], 0, 1e-3);
        assert_true(flip_hdr(&pair, FLIP_ACES, p->errors, &exposures));
        CHECK_NEAR(p->errors[7], 1, 0);
        assert_true(isfinite(exposures.first) && isfinite(exposures.last));
        for (size_t at = 0; at < COUNT; at++)
            assert_true(p->errors[at] >= 0.0f && p->errors[at] <= 1.0f);
        free(p);
    }
}

/* Both exposures show another part of the picture; the greater error counts. */
static void test_hdr_takes_the_worst(void **state)
{
    struct pictures *p = make_pictures(0.5f, 0.5f);
    const struct flip_pair pair = pair_of(p);
    struct flip_exposures exposures;
    float errors[COUNT];

    (void)state;
    for (size_t c = 0; c < 6; c++)
        p->texels[c][0] = 400.0f;
    for (size_t c = 3; c < 6; c++) {
        p->texels[c][0] = 200.0f;
        p->texels[c][COUNT - 1] = 0.4f;
    }
    assert_true(flip_hdr(&pair, FLIP_REINHARD, p->errors, &exposures));
    assert_int_equal(exposures.count, 10); /* log2(400 / 0.5) is 9.64 */
    assert_true(flip_ldr(&pair, 0.0, errors));
    assert_true(errors[0] < 1e-3f && p->errors[0] > 0.1f);
    assert_true(p->errors[COUNT - 1] > 0.1f);
    free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_opponent),
        cmocka_unit_test(test_hunt),
        cmocka_unit_test(test_distance),
        cmocka_unit_test(test_error),
        cmocka_unit_test(test_sensitivity),
        cmocka_unit_test(test_features),
        cmocka_unit_test(test_every_ppd_fits),
        cmocka_unit_test(test_filter_reaches_where_it_should),
        cmocka_unit_test(test_tone),
        cmocka_unit_test(test_exposures),
        cmocka_unit_test(test_flat),
        cmocka_unit_test(test_same),
        cmocka_unit_test(test_feature_raises_error),
        cmocka_unit_test(test_not_finite_is_an_error),
        cmocka_unit_test(test_hdr_takes_the_worst),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
