/* test_pixel_filter.c: distribution of sample positions in a pixel. */
#include "src/render/pixel_filter.h"

#include <math.h>
#include <stdlib.h>

#include "tests/support/assertions.h"

static void jitter_stays_in_the_pixel(void **state)
{
    (void)state;
    assert_true(pixel_filter_jitter(0).x == 0.0f && pixel_filter_jitter(0).y == 0.0f);
    for (uint32_t i = 0; i < 100000; i++) {
        /* small counts, the last ones there are, and those around one that is nearly 0.5 */
        const vec2s jitters[] = {
            pixel_filter_jitter(i),
            pixel_filter_jitter(UINT32_MAX - i),
            pixel_filter_jitter(7913000 + i),
        };
        for (size_t k = 0; k < sizeof(jitters) / sizeof(jitters[0]); k++) {
            assert_true(jitters[k].x >= -0.5f && jitters[k].x < 0.5f);
            assert_true(jitters[k].y >= -0.5f && jitters[k].y < 0.5f);
        }
    }
}

/* At any count the samples balance, and each quarter of the pixel has its share. */
static void jitter_is_even(void **state)
{
    (void)state;
    double x = 0.0, y = 0.0;
    int quarters[4] = { 0 };
    for (uint32_t i = 0; i < 1024; i++) {
        vec2s jitter = pixel_filter_jitter(i);
        int count = (int)i + 1;
        x += (double)jitter.x;
        y += (double)jitter.y;
        quarters[(jitter.x >= 0.0f) + 2 * (jitter.y >= 0.0f)]++;
        /* the mean's error falls as 1 / count; of random samples it would fall as its root */
        assert_true(fabs(x) < 2.5 && fabs(y) < 2.5);
        for (int q = 0; q < 4; q++)
            assert_true(abs(quarters[q] * 4 - count) <= 16);
    }
}

static double window_height(double x)
{
    const double at = 3.14159265358979323846 * x / 1.5;
    return 0.35875 + 0.48829 * cos(at) + 0.14128 * cos(2 * at) + 0.01168 * cos(3 * at);
}

/* Of the samples, a share is left of any place: that of the window's area. */
static void samples_are_as_dense_as_the_window_is_high(void **state)
{
    enum {
        BIN_COUNT = 30,
        SAMPLE_COUNT = 20000,
    };

    int counts[2][BIN_COUNT] = { { 0 } };
    double area = 0;
    (void)state;
    for (uint32_t i = 0; i < SAMPLE_COUNT; i++) {
        const vec2s at = pixel_filter_offset(PIXEL_FILTER_BLACKMAN_HARRIS, i);
        for (int axis = 0; axis < 2; axis++) {
            const double bin = floor(((double)at.raw[axis] + 1.5) / 3 * BIN_COUNT);
            assert_true(bin >= 0 && bin < BIN_COUNT);
            counts[axis][(int)bin]++;
        }
    }
    for (int i = 0; i < BIN_COUNT; i++)
        area += window_height(((i + 0.5) / BIN_COUNT - 0.5) * 3);
    for (int i = 0; i < BIN_COUNT; i++) {
        const double share = window_height(((i + 0.5) / BIN_COUNT - 0.5) * 3) / area;
        for (int axis = 0; axis < 2; axis++)
            CHECK_NEAR(counts[axis][i] / (double)SAMPLE_COUNT, share, 6e-4);
    }
}

static void the_first_sample_is_the_centre(void **state)
{
    (void)state;
    for (int filter = 0; filter < PIXEL_FILTER_COUNT; filter++) {
        const vec2s first = pixel_filter_offset((enum pixel_filter)filter, 0);
        const vec2s second = pixel_filter_offset((enum pixel_filter)filter, 1);
        assert_true(first.x == 0.0f && first.y == 0.0f);
        assert_int_equal(second.x != 0.0f, filter != PIXEL_FILTER_POINT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(jitter_stays_in_the_pixel),
        cmocka_unit_test(jitter_is_even),
        cmocka_unit_test(samples_are_as_dense_as_the_window_is_high),
        cmocka_unit_test(the_first_sample_is_the_centre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
