/* What frames wait for, from running means. */
#include "src/view/panels/ui_frame_bottleneck.h"
#include "tests/support/assertions.h"

static const char *limit_of(double device, double screen)
{
    const struct ui_frame_pacing sample = { 1.0, device, screen };
    struct ui_frame_pacing pace = { 0 };
    ui_frame_pacing_add(&pace, &sample);
    return ui_frame_pacing_limit(&pace);
}

static void test_limit(void **state)
{
    (void)state;
    assert_string_equal(limit_of(0.95, 0.9), "the device");
    assert_string_equal(limit_of(0.2, 0.6), "the screen");
    assert_string_equal(limit_of(0.5, 0.6),
                        "the host"); /* the present wait is mostly time of the device */
    assert_null(limit_of(-1.0, 0.9));
    assert_string_equal(limit_of(0.3, 0.1), "the host");
}

static void test_means(void **state)
{
    (void)state;
    const struct ui_frame_pacing slow = { .frame = 1.0 };
    const struct ui_frame_pacing fast = { .frame = 0.5, .device = 0.25 };
    const struct ui_frame_pacing none = { .device = 9.0 };
    struct ui_frame_pacing pace = { 0 };
    ui_frame_pacing_add(&pace, &slow);
    assert_float_equal(pace.frame, 1.0, 0.0);
    ui_frame_pacing_add(&pace, &none);
    assert_float_equal(pace.device, 0.0, 0.0);
    ui_frame_pacing_add(&pace, &fast);
    assert_true(pace.frame < 1.0 && pace.frame > 0.9);
    for (int i = 0; i < 200; i++)
        ui_frame_pacing_add(&pace, &fast);
    assert_float_equal(pace.frame, 0.5, 1e-6);
    assert_float_equal(pace.device, 0.25, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
