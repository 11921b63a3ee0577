/*
 * test_exec_time.c: what is measured of a frame, by every clock: counts that are known, and times
 * that fit into each other. How long anything takes is no test's business.
 */
#include "tests/support/assertions.h"

#include "tests/support/feature_graphs.h"
#include "tests/support/lavapipe.h"

enum {
    LEFT,
    ALL_OF_IT,
    FILL,
    READ,
    PASS_COUNT,
};

static const struct rg_image half = COLOR_IMAGE("half");
static const struct rg_image whole = COLOR_IMAGE("whole");
static const struct rg_image texels = { .name = "texels", .format = VK_FORMAT_R32_UINT };
static const struct rg_buffer whole_out = COLOR_BUFFER("whole out");
static const struct rg_buffer numbers = FEATURE_NUMBERS("numbers");

static const struct rg_pass rows[PASS_COUNT] = {
    [LEFT] = { .name = "left", .color = RG_TARGETS({ &half, RG_LOAD_CLEAR }), PAINTED },
    [ALL_OF_IT] = PAINTED_FETCH("all of it", half, whole),
    [FILL] = { .name = "fill", FEATURE_FILL(texels, numbers) },
    [READ] = RUN_READ("read", whole, whole_out),
};

static const struct paint_push paints[PASS_COUNT] = {
    [LEFT] = { .color = { { 1, 2, 3, 4 } }, LEFT_HALF },
    [ALL_OF_IT] = { .color = { { 10, 10, 10, 10 } }, ALL },
};

static const struct run_params params = {
    .technique = RG_TECHNIQUE("test", rows),
    .outputs = { &whole_out, &numbers },
};

static struct rg_times draw(struct run *run)
{
    const struct rg_frame frame = { .rows = rows, .paints = paints };
    assert_int_equal(rg_exec_begin(run->exec, &run->slot), VK_SUCCESS);
    *(struct data_seed *)run_data(run, &feature_seed) = (struct data_seed){ 5 };
    assert_int_equal(rg_exec_submit(run->exec, &frame), VK_SUCCESS);
    assert_int_equal(rg_exec_wait(run->exec, run->slot), VK_SUCCESS);
    const uint32_t *filled = run_data(run, &numbers);
    for (uint32_t i = 0; i < FEATURE_TEXELS; i++) {
        const float in_half = i % FEATURE_SIZE < FEATURE_SIZE / 2 ? 1 : 0;
        painted_check(
            run, &whole_out, i,
            painted_color(10 + in_half, 10 + 2 * in_half, 10 + 3 * in_half, 10 + 4 * in_half));
        assert_int_equal(filled[i], 3 * (5 + i));
    }
    return rg_exec_times(run->exec);
}

/* ---- times ---- */

static uint64_t check_passes(const struct rg_times *times)
{
    uint64_t device = 0;
    uint64_t record = 0;
    for (uint32_t p = 0; p < PASS_COUNT; p++) {
        const struct rg_pass_time *time = &times->passes[p];
        const bool is_timed = times->measure.clock != RG_CLOCK_NONE;
        assert_int_equal(time->begin, device); /* where the one before has ended */
        assert_true(is_timed ? time->end > time->begin : time->end == 0);
        assert_true(time->record > 0 && time->record_begin >= record);
        device = time->end;
        record = time->record_begin + time->record;
    }
    assert_true(record <= times->whole);
    return device;
}

static void check_times(const struct rg_times *times, enum rg_clock clock)
{
    assert_int_equal(times->measure.clock, clock);
    assert_int_equal(times->pass_count, PASS_COUNT);
    const uint64_t device = check_passes(times);
    assert_true(times->start > 0 && times->record > 0 && times->wait > 0);
    assert_true((times->submit > 0) == (clock != RG_CLOCK_SUBMITS));
    assert_true(times->begin + times->record + times->submit + times->wait <= times->whole);
    assert_true(device <= times->whole);
    if (clock == RG_CLOCK_SUBMITS) /* all by one clock */
        assert_true(times->begin + times->record + device <= times->whole);
}

static void every_clock_times_every_pass(void **state)
{
    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        struct run_params wanted = run_variant(&params, way);
        wanted.measure = (struct rg_measure){ RG_CLOCK_EXACT, true };
        struct run run;
        run_open(&run, *state, &wanted);
        for (enum rg_clock clock = RG_CLOCK_NONE; clock < RG_CLOCK_COUNT; clock++) {
            assert_true(rg_exec_has_clock(run.exec, clock));
            rg_exec_measure(run.exec, &(struct rg_measure){ clock, clock % 2 });
            for (unsigned frame = 0; frame < 3; frame++) {
                const struct rg_times times = draw(&run);
                check_times(&times, clock);
            }
        }
        run_close(&run);
    }
}

/* A frame is over when it is waited for, not when the next one begins. */
static void times_are_those_of_the_frame_seen_last(void **state)
{
    struct run_params wanted = params;
    struct run run;
    wanted.measure.clock = RG_CLOCK_STREAM;
    run_open(&run, *state, &wanted);
    assert_null(rg_exec_times(run.exec).passes);
    const uint64_t first = draw(&run).start;
    const uint64_t second = draw(&run).start;
    assert_true(second > first);
    const struct rg_frame frame = { .rows = rows, .paints = paints };
    for (unsigned i = 0; i < 2; i++) { /* both slots, not waited for */
        assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
        assert_int_equal(rg_exec_submit(run.exec, &frame), VK_SUCCESS);
        assert_int_equal(rg_exec_times(run.exec).start, second);
    }
    assert_int_equal(rg_exec_begin(run.exec, &run.slot), VK_SUCCESS);
    const struct rg_times times = rg_exec_times(run.exec);
    assert_true(times.start > second);
    assert_int_equal(times.measure.clock, RG_CLOCK_STREAM);
    (void)check_passes(&times);
    run_close(&run);
}

static void nothing_is_measured_unasked(void **state)
{
    struct run run;
    run_open(&run, *state, &params);
    assert_false(rg_exec_has_clock(run.exec, RG_CLOCK_EXACT));
    rg_exec_measure(run.exec, &(struct rg_measure){ RG_CLOCK_EXACT, true });
    const struct rg_times times = draw(&run);
    assert_null(times.passes);
    assert_int_equal(times.measure.clock, RG_CLOCK_NONE);
    run_close(&run);
}

/* ---- counts ---- */

static void work_is_counted(void **state)
{
    static const struct {
        uint64_t vertices, triangles, samples, invocations;
    } expected[PASS_COUNT] = {
        [LEFT] = { 6, 2, FEATURE_TEXELS / 2, 0 },
        [ALL_OF_IT] = { 6, 2, FEATURE_TEXELS, 0 },
        [FILL] = { .invocations = FEATURE_TEXELS },
    };

    for (unsigned way = 0; way < RUN_VARIANT_COUNT; way++) {
        struct run_params wanted = run_variant(&params, way);
        wanted.measure.statistics = true;
        struct run run;
        run_open(&run, *state, &wanted);
        const struct rg_times times = draw(&run);
        for (uint32_t p = 0; p < PASS_COUNT; p++) {
            assert_int_equal(times.passes[p].vertices, expected[p].vertices);
            assert_int_equal(times.passes[p].triangles, expected[p].triangles);
            assert_int_equal(times.passes[p].samples, expected[p].samples);
            assert_int_equal(times.passes[p].invocations, expected[p].invocations);
            assert_true(times.passes[p].fragments >= expected[p].samples);
        }
        run_close(&run);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_DEVICE(every_clock_times_every_pass),
        ON_DEVICE(times_are_those_of_the_frame_seen_last),
        ON_DEVICE(nothing_is_measured_unasked),
        ON_DEVICE(work_is_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
