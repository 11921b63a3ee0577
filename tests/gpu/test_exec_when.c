/* test_exec_when.c: conditional passes: what they leave stays until they run again. */
#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    FRAMES = 7,
};

static const bool wanted[FRAMES] = { false, true, false, false, true, true, false };

enum {
    LAYER_LEFT_OUT = 4, /* a frame that draws only one of two layers */
};

static uint32_t asked; /* in frames of one series */

#define PAINTS(number) \
    { \
        [WHEN_CAPTURE] = { .color = { { 10 * (number), 1, 2, 3 } }, ALL }, \
        [WHEN_SHOW] = { .color = { { 0, 100, 0, 0 } }, ALL }, \
        [WHEN_CLEAR] = { .color = { { 100 * (number), 0, 0, 0 } }, TOP_HALF }, \
        [WHEN_MARK] = { .color = { { 1, 2, 0, 0 } }, ALL }, \
        [WHEN_FIRST] = { .color = { { (number), 0, 0, 0 } }, LEFT_HALF }, \
        [WHEN_SECOND] = { .color = { { 1000, 0, 0, (number) } }, ALL }, \
    }

static void begin(struct run *run, uint32_t number, struct rg_frame *frame)
{
    static const struct paint_push paints[FRAMES][WHEN_PAINT_COUNT] = {
        PAINTS(1), PAINTS(2), PAINTS(3), PAINTS(4), PAINTS(5), PAINTS(6), PAINTS(7),
    };
    if (number == 0)
        asked = 0;
    assert_int_equal(asked, number * WHEN_PASS_COUNT);
    frame->asked = &asked;
    frame->paints = paints[number];
    frame->wanted = wanted[number];
    frame->left_out = number == LAYER_LEFT_OUT ? 1u << 1 : 0;
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ 1000 * (number + 1) };
}

/* Before any frame was wanted. */
static void check_zeros(struct run *run, uint32_t number)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    const uint32_t *numbers = run_data(run, outputs[WHEN_NUMBERS_OUT]);
    const uint32_t *list = run_data(run, outputs[WHEN_LIST_OUT]);
    const float marks = (float)(number + 1);
    painted_check_all(run, outputs[WHEN_SHOWN_OUT], FEATURE_TEXELS, painted_color(0, 100, 0, 0));
    painted_check_all(run, outputs[WHEN_BOARD_OUT], FEATURE_TEXELS,
                      painted_color(marks, 2 * marks, 0, 0));
    painted_check_all(run, outputs[WHEN_RESULT_OUT], FEATURE_TEXELS, painted_color(0, 0, 0, 0));
    painted_check_all(run, outputs[WHEN_SNAPSHOT_OUT], FEATURE_TEXELS, painted_color(0, 0, 0, 0));
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        assert_int_equal(numbers[i], 0);
        assert_int_equal(list[i], 0);
    }
}

/* What the frame `last` has left, the last one that was wanted. */
static void check_left(struct run *run, uint32_t number, uint32_t last)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    const uint32_t *numbers = run_data(run, outputs[WHEN_NUMBERS_OUT]);
    const uint32_t *list = run_data(run, outputs[WHEN_LIST_OUT]);
    const float n = (float)(last + 1);
    const float shown = last == LAYER_LEFT_OUT ? 2 : n; /* of frame 1 */
    const float marks = (float)(number - last + 1);
    painted_check_all(run, outputs[WHEN_SHOWN_OUT], FEATURE_TEXELS,
                      painted_color(10 * shown + 2, 101, 2, 3));
    painted_check_all(run, outputs[WHEN_SNAPSHOT_OUT], FEATURE_TEXELS,
                      painted_color(10 * n + 1, 1, 2, 3));
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        painted_check(run, outputs[WHEN_BOARD_OUT], i,
                      i / 8 < 4 ? painted_color(100 * n + marks, 2 * marks, 0, 0)
                                : painted_color(7 + marks, 7 + 2 * marks, 7, 7));
        painted_check(run, outputs[WHEN_RESULT_OUT], i,
                      i % 8 < 4 ? painted_color(1000 + n, 0, 0, n)
                                : painted_color(1005, 5, 5, 5 + n));
        assert_int_equal(numbers[i], 1000 * (last + 1) + i);
        assert_int_equal(list[i], 3 * (1000 * (last + 1) + i));
    }
}

static void check(struct run *run, uint32_t number)
{
    uint32_t last = number;
    while (last > 0 && !wanted[last])
        last--;
    if (wanted[last])
        check_left(run, number, last);
    else
        check_zeros(run, number);
}

static void passes_run_when_wanted(void **state)
{
    static const struct painted_series series = { FRAMES, begin, check };
    painted_series_variants(*state, &feature_when.params, &series);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(passes_run_when_wanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
