/* test_undo_stack.c: changes are taken back and done again. */
#include <string.h>
#include "src/view/session/undo_stack.h"
#include "tests/support/assertions.h"

static struct view_state state_with(double count)
{
    struct view_state state = { .settings = settings_default() };
    settings_set_value(&state.settings, settings_find("cracks.count"), count);
    return state;
}

static double count_of(const struct view_state *state)
{
    assert_non_null(state);
    return settings_get(&state->settings, settings_find("cracks.count"));
}

static void add(struct undo_stack *history, double count, uint32_t gesture)
{
    const struct view_state state = state_with(count);
    undo_stack_push(history, &state, gesture);
}

static void undo_and_redo_walk_the_list(void **state)
{
    (void)state;
    struct undo_stack h = { .count = 0 };
    assert_null(undo_stack_undo(&h));
    assert_null(undo_stack_redo(&h));
    for (double i = 1; i <= 3; i++)
        add(&h, i, 0);
    assert_null(undo_stack_redo(&h));
    CHECK_NEAR(count_of(undo_stack_undo(&h)), 2, 0);
    CHECK_NEAR(count_of(undo_stack_undo(&h)), 1, 0);
    assert_null(undo_stack_undo(&h));
    CHECK_NEAR(count_of(undo_stack_redo(&h)), 2, 0);
    add(&h, 9, 0);
    assert_null(undo_stack_redo(&h)); /* 3 is forgotten */
    CHECK_NEAR(count_of(undo_stack_undo(&h)), 2, 0);
}

static void one_gesture_is_one_entry(void **state)
{
    (void)state;
    struct undo_stack h = { .count = 0 };
    add(&h, 1, 0);
    for (double i = 2; i <= 6; i++)
        add(&h, i, 7);
    add(&h, 10, 8);
    add(&h, 11, 8);
    CHECK_NEAR(count_of(undo_stack_undo(&h)), 6, 0);
    add(&h, 12, 8); /* an entry of its own: what it would go on with was undone */
    CHECK_NEAR(count_of(undo_stack_undo(&h)), 6, 0);
    CHECK_NEAR(count_of(undo_stack_undo(&h)), 1, 0);
    assert_null(undo_stack_undo(&h));
}

static void nothing_new_is_no_entry(void **state)
{
    (void)state;
    struct undo_stack h = { .count = 0 };
    add(&h, 1, 0);
    add(&h, 1, 0);
    assert_null(undo_stack_undo(&h));
}

static void the_oldest_are_forgotten(void **state)
{
    (void)state;
    struct undo_stack h = { .count = 0 };
    uint32_t count = 0;
    for (double i = 0; i < 3 * UNDO_STACK_COUNT; i++)
        add(&h, i, 0);
    while (undo_stack_undo(&h))
        count++;
    assert_int_equal(count, UNDO_STACK_COUNT - 1);
    CHECK_NEAR(count_of(&h.states[h.at]), 2 * UNDO_STACK_COUNT, 0);
}

static void words_say_what_differs(void **state)
{
    (void)state;
    char text[64];
    const struct view_state a = state_with(2);
    struct view_state b = state_with(5);
    undo_stack_describe(&a, &b, text, sizeof(text));
    assert_string_equal(text, "Cracks 2 -> 5");
    settings_set_value(&b.settings, settings_find("tonemap.exposure"), 1);
    undo_stack_describe(&a, &b, text, sizeof(text));
    assert_string_equal(text, "Cracks 2 -> 5 and 1 more");
    undo_stack_describe(&a, &b, text, 10);
    assert_true(strlen(text) < 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(undo_and_redo_walk_the_list), cmocka_unit_test(one_gesture_is_one_entry),
        cmocka_unit_test(nothing_new_is_no_entry),     cmocka_unit_test(the_oldest_are_forgotten),
        cmocka_unit_test(words_say_what_differs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
