/* test_exec_history.c: persistent images and buffers: zero at first, then what the frame before
 * has left, with two frames in flight. */
#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    FRAMES = 6,
};

/* ---- images ---- */

/* Reversed: the first frame finds 0, farther than all. */
static const float depths[FRAMES] = { 0.5F, 0.25F, 0.75F, 0.625F, 0.875F, 0.125F };

#define PAINTS(number, z) \
    { \
        [HISTORY_SUM] = { .color = { { (number), 1, 0, 0 } }, LEFT_HALF }, \
        [HISTORY_SEE] = { ALL }, [HISTORY_BEFORE] = { ALL }, \
        [HISTORY_KEEP] = { .color = { { 10 * (number), 2, 3, 4 } }, TOP_HALF }, \
        [HISTORY_NOW] = { .color = { { (number), 5, 6, 7 } }, LEFT_HALF }, \
        [HISTORY_LAST] = { ALL }, \
        [HISTORY_NEAREST] = { .color = { { (number), 0, 0, 1 } }, LEFT_HALF, .depth = (z) }, \
        [HISTORY_LAYERS] = { .color = { { (number), 1, 0, 0 } }, ALL }, \
        [HISTORY_MIPS] = { .color = { { (number), 2, 0, 0 } }, ALL }, \
    }

static void begin_images(struct run *run, uint32_t number, struct rg_frame *frame)
{
    static const struct paint_push paints[FRAMES][HISTORY_PAINT_COUNT] = {
        PAINTS(1, 0.5F),   PAINTS(2, 0.25F),  PAINTS(3, 0.75F),
        PAINTS(4, 0.625F), PAINTS(5, 0.875F), PAINTS(6, 0.125F),
    };
    (void)run;
    frame->paints = paints[number];
}

static void check_depth(struct run *run, uint32_t number)
{
    const float *texels = run_data(run, run->params.outputs[HISTORY_DEPTH_OUT]);
    float before = 0;
    for (uint32_t i = 0; i < number; i++)
        before = depths[i] > before ? depths[i] : before;
    const bool nearer = depths[number] > before;
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        const bool left = i % 8 < 4;
        CHECK_NEAR(texels[i], !left ? 0 : nearer ? depths[number] : before, 0);
        painted_check(run, run->params.outputs[HISTORY_NEAREST_OUT], i,
                      left && nearer ? painted_color((float)(number + 1), 0, 0, 1)
                                     : painted_color(0, 0, 0, 0));
    }
}

static void check_images(struct run *run, uint32_t number)
{
    const struct rg_buffer *const *outputs = run->params.outputs;
    const float frames = (float)(number + 1);
    const float sum = frames * (frames + 1) / 2;
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        painted_check(run, outputs[HISTORY_SEEN_OUT], i,
                      i % 8 < 4 ? painted_color(sum, frames, 0, 0) : painted_color(0, 0, 0, 0));
        for (uint32_t k = 0; k < 2; k++)
            painted_check(run, outputs[HISTORY_NOW_OUT + k], i,
                          i % 8 < 4 && number >= k ? painted_color(frames - (float)k, 5, 6, 7)
                                                   : painted_color(0, 0, 0, 0));
        if (number == 0)
            painted_check(run, outputs[HISTORY_BEFORE_OUT], i, painted_color(0, 0, 0, 0));
        else if (i / 8 < 4) /* the rest was discarded */
            painted_check(run, outputs[HISTORY_BEFORE_OUT], i,
                          painted_color(10 * (float)number, 2, 3, 4));
    }
    check_depth(run, number);
    for (uint32_t i = 0; i < HISTORY_LAYER_COUNT * HISTORY_SIDE * HISTORY_SIDE; i++) {
        const uint32_t number_of_layer = i / (HISTORY_SIDE * HISTORY_SIDE) + 1;
        painted_check(run, outputs[HISTORY_LAYERS_OUT], i,
                      painted_color(sum + frames * (float)number_of_layer, frames, 0, 0));
    }
    for (uint32_t mip = 0; mip < HISTORY_MIP_COUNT; mip++) {
        const uint32_t side = HISTORY_SIDE >> mip;
        painted_check_all(run, outputs[HISTORY_MIPS_OUT + mip], side * side,
                          painted_color(sum + frames * (float)(mip + 1), 2 * frames, 0, 0));
    }
}

static void images_are_kept(void **state)
{
    static const struct painted_series series = { FRAMES, begin_images, check_images };
    painted_series_variants(*state, &feature_history.params, &series);
}

/* The last frame before an update has an odd or an even number. */
static void images_survive_updates(void **state)
{
    struct run run;
    run_open(&run, *state, &feature_history.params);
    for (uint32_t number = 0; number < FRAMES; number++) {
        struct rg_frame frame = { .rows = feature_history.params.technique.passes };
        if (number % 3 > 0)
            run_update(&run, &feature_history.params);
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        begin_images(&run, number, &frame);
        assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
        assert_int_equal(rg_exec_wait(run.exec, run.slot), VK_SUCCESS);
        check_images(&run, number);
    }
    run_close(&run);
}

/* ---- buffers ---- */

/* What a frame writes, byte by byte. */
static unsigned char byte_of(uint32_t number, uint32_t i)
{
    return (unsigned char)(number * 31 + i * 7 + 1);
}

static void begin_buffers(struct run *run, uint32_t number, struct rg_frame *frame)
{
    (void)frame;
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ 100 * (number + 1) };
    unsigned char *bytes = run_data(run, &feature_history_bytes_in);
    for (uint32_t i = 0; i < HISTORY_BYTES; i++)
        bytes[i] = byte_of(number, i);
}

static void check_buffers(struct run *run, uint32_t number)
{
    const uint32_t *total = run_data(run, run->params.outputs[HISTORY_TOTAL_OUT]);
    const unsigned char *bytes = run_data(run, run->params.outputs[HISTORY_BYTES_OUT]);
    const uint32_t frames = number + 1;
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++)
        assert_int_equal(total[i], 100 * (frames * (frames + 1) / 2) + frames * i);
    for (uint32_t i = 0; i < HISTORY_BYTES; i++)
        assert_int_equal(bytes[i], number ? byte_of(number - 1, i) : 0);
}

static void buffers_are_kept(void **state)
{
    static const struct painted_series series = { FRAMES, begin_buffers, check_buffers };
    painted_series_variants(*state, &feature_history_buffers.params, &series);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(images_are_kept),
        ON_DEVICE(images_survive_updates),
        ON_DEVICE(buffers_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
