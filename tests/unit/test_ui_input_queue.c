/* Events come to frames in an order that panels can follow. */
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include "src/view/panels/ui_input_queue.h"
#include "tests/support/assertions.h"

static void move(struct ui_input_queue *input, double x)
{
    ui_input_queue_add(input, &(struct window_event){ WINDOW_CURSOR, x, 2.0 * x });
}

static void press(struct ui_input_queue *input, bool down)
{
    ui_input_queue_add(input, &(struct window_event){ .kind = WINDOW_BUTTON, .down = down });
}

static void key(struct ui_input_queue *input, int code, bool down, bool control)
{
    ui_input_queue_add(input, &(struct window_event){
                                  .kind = WINDOW_KEY,
                                  .code = code,
                                  .down = down,
                                  .control = control,
                              });
}

static void type(struct ui_input_queue *input, int character)
{
    ui_input_queue_add(input,
                       &(struct window_event){ .kind = WINDOW_CHARACTER, .code = character });
}

/* A drag within one frame begins where the button went down and ends where it went up. */
static void test_drag(void **state)
{
    (void)state;
    struct ui_input_queue input = { 0 };
    move(&input, 1.0);
    move(&input, 2.0);
    press(&input, true);
    move(&input, 7.0);
    press(&input, false);
    move(&input, 9.0);
    assert_int_equal(input.event_count, 5); /* the two first moves are one */
    ui_input_queue_step(&input);
    assert_false(input.now.buttons[0]); /* first the cursor is there */
    assert_float_equal(input.now.x, 2.0f, 0.0f);
    ui_input_queue_step(&input);
    assert_true(input.now.buttons[0]);
    assert_float_equal(input.now.x, 2.0f, 0.0f);
    assert_float_equal(input.now.y, 4.0f, 0.0f);
    ui_input_queue_step(&input);
    assert_float_equal(input.now.x, 7.0f, 0.0f);
    assert_true(input.now.buttons[0]); /* what is dragged gets there before it is let go */
    ui_input_queue_step(&input);
    assert_float_equal(input.now.x, 7.0f, 0.0f);
    assert_false(input.now.buttons[0]);
    ui_input_queue_step(&input);
    assert_float_equal(input.now.x, 9.0f, 0.0f);
    assert_int_equal(input.event_count, 0);
}

static void test_click_is_seen(void **state)
{
    (void)state;
    struct ui_input_queue input = { 0 };
    press(&input, true);
    press(&input, false);
    ui_input_queue_step(&input);
    assert_true(input.now.buttons[0]);
    ui_input_queue_step(&input);
    assert_false(input.now.buttons[0]);
}

static void test_wheel(void **state)
{
    (void)state;
    struct ui_input_queue input = { 0 };
    const struct window_event turn = { WINDOW_WHEEL, 0.0, 1.5 };
    ui_input_queue_add(&input, &turn);
    ui_input_queue_add(&input, &turn);
    ui_input_queue_step(&input);
    assert_float_equal(input.now.wheel, 3.0f, 0.0f);
    ui_input_queue_step(&input);
    assert_float_equal(input.now.wheel, 0.0f, 0.0f);
}

/* Typing takes one frame however many letters; a key that panels know comes after what it ends. */
static void test_text(void **state)
{
    (void)state;
    struct ui_input_queue input = { 0 };
    for (const char *c = "abc"; *c; c++) {
        key(&input, GLFW_KEY_A + (*c - 'a'), true, false);
        type(&input, *c);
        key(&input, GLFW_KEY_A + (*c - 'a'), false, false);
    }
    key(&input, GLFW_KEY_ENTER, true, false);
    key(&input, GLFW_KEY_ENTER, false, false);
    ui_input_queue_step(&input);
    assert_int_equal(input.now.character_count, 3);
    assert_int_equal(input.now.characters[2], 'c');
    assert_false(input.now.keys[IMGUI_ENTER]);
    ui_input_queue_step(&input);
    assert_int_equal(input.now.character_count, 0);
    assert_true(input.now.keys[IMGUI_ENTER]);
    ui_input_queue_step(&input);
    assert_false(input.now.keys[IMGUI_ENTER]);
}

static void test_control_keys(void **state)
{
    (void)state;
    struct ui_input_queue input = { 0 };
    key(&input, GLFW_KEY_V, true, true);
    key(&input, GLFW_KEY_V, false, false); /* Ctrl went up first */
    ui_input_queue_step(&input);
    assert_true(input.now.keys[IMGUI_V] && input.now.control);
    ui_input_queue_step(&input);
    assert_false(input.now.keys[IMGUI_V] || input.now.control);
}

/* More than there is room for: what stays down at the end is down. */
static void test_overflow(void **state)
{
    (void)state;
    struct ui_input_queue input = { 0 };
    for (int i = 0; i < 2 * UI_INPUT_QUEUE_COUNT; i++)
        press(&input, i % 2 == 0);
    press(&input, true);
    assert_int_equal(input.event_count, UI_INPUT_QUEUE_COUNT);
    while (input.event_count)
        ui_input_queue_step(&input);
    assert_true(input.now.buttons[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drag),         cmocka_unit_test(test_click_is_seen),
        cmocka_unit_test(test_wheel),        cmocka_unit_test(test_text),
        cmocka_unit_test(test_control_keys), cmocka_unit_test(test_overflow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
