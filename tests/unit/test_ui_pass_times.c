/* Running means of the passes' times. */
#include <stdlib.h>
#include <string.h>
#include "graph/rg.h"
#include "src/view/panels/ui_pass_times.h"
#include "tests/support/assertions.h"

/* A frame of two passes, 2 ms and `second` ms. */
static void add(struct ui_pass_times *times, const char *second_name, uint64_t second)
{
    char *name = strdup(second_name);
    struct rg_pass *rows = calloc(2, sizeof(*rows));
    struct rg_plan_pass passes[2] = { { .pass = &rows[0] }, { .pass = &rows[1] } };
    struct rg_pass_time ends[2] = { { 0, 2000000 }, { 2000000, 2000000 + second * 1000000 } };
    const struct rg_plan plan = { .passes = passes, .pass_count = 2 };
    assert_non_null(name);
    assert_non_null(rows);
    rows[0].name = "first";
    rows[1].name = name;
    const struct rg_times frame = { .passes = ends,
                                    .pass_count = 2,
                                    .start = times->frame_count + 1 };
    ui_pass_times_add(times, &plan, &frame);
    ui_pass_times_add(times, &plan, &frame); /* a window may look at it twice */
    memset(name, '-', strlen(name));
    free(name); /* as with a plan that is replaced */
    free(rows);
}

static void names_outlive_their_plan(void **state)
{
    (void)state;
    struct ui_pass_times times = { 0 };
    add(&times, "second", 4);
    assert_int_equal(times.row_count, 2);
    assert_string_equal(times.rows[0].name, "first");
    assert_string_equal(times.rows[1].name, "second");
    assert_float_equal(ui_pass_times_sum(&times), 6.0, 1e-9);
}

static void means_follow_slowly_and_begin_anew_with_other_rows(void **state)
{
    (void)state;
    struct ui_pass_times times = { 0 };
    add(&times, "second", 4);
    add(&times, "second", 5);
    assert_true(times.rows[1].milliseconds > 4.0 && times.rows[1].milliseconds < 4.5);
    add(&times, "another", 5);
    assert_float_equal(times.rows[1].milliseconds, 5.0, 1e-9);
    assert_float_equal(times.rows[0].milliseconds, 2.0, 1e-9);
}

static void frames_stay_when_plans_change(void **state)
{
    (void)state;
    struct ui_pass_times times = { 0 };
    add(&times, "second", 4);
    add(&times, "another", 5);
    assert_float_equal(times.frames[0], 6.0, 1e-6);
    assert_float_equal(times.frames[1], 7.0, 1e-6);
    for (uint32_t i = 0; i < UI_PASS_TIMES_FRAME_COUNT; i++)
        add(&times, "second", 6);
    assert_int_equal(times.frame_count, UI_PASS_TIMES_FRAME_COUNT + 2);
    assert_float_equal(times.frames[0], 8.0, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_outlive_their_plan),
        cmocka_unit_test(means_follow_slowly_and_begin_anew_with_other_rows),
        cmocka_unit_test(frames_stay_when_plans_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
