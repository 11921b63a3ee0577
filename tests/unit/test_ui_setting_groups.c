/* test_ui_setting_groups.c: every setting is in one group. */
#include <string.h>
#include "src/view/panels/ui_setting_groups.h"
#include "tests/support/assertions.h"

static uint32_t count_of(const struct setting *row)
{
    const struct setting *next;
    uint32_t count = 0;
    for (enum ui_setting_group g = UI_OBJECT; g < UI_GROUP_COUNT; g++) {
        for (uint32_t i = 0; (next = ui_setting_groups_row(g, i)); i++) {
            count += next == row;
            assert_int_equal(ui_setting_groups_of(next), g);
        }
    }
    return count;
}

static void each_setting_is_there_once(void **state)
{
    (void)state;
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row))
        assert_int_equal(count_of(row), 1);
}

static void what_has_no_row_is_for_experts(void **state)
{
    (void)state;
    const struct setting made_up = { .name = "made.up" };
    assert_int_equal(ui_setting_groups_of(&made_up), UI_EXPERT);
    assert_int_equal(ui_setting_groups_of(settings_find("refract_search.steps")), UI_EXPERT);
    assert_int_equal(ui_setting_groups_of(settings_find("cracks.count")), UI_INSIDE);
}

static void no_group_is_empty(void **state)
{
    (void)state;
    for (enum ui_setting_group g = UI_OBJECT; g < UI_GROUP_COUNT; g++) {
        assert_non_null(ui_setting_groups_row(g, 0));
        assert_true(strlen(ui_setting_groups_name(g)) > 3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_setting_is_there_once),
        cmocka_unit_test(what_has_no_row_is_for_experts),
        cmocka_unit_test(no_group_is_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
