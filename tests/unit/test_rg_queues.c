/* test_rg_queues.c: submissions and barriers of plans for several queues. */
#include "tests/support/assertions.h"
#include "tests/support/hazard_checker.h"
#include "tests/support/small_graph.h"

static const struct rg_image shared = IMAGE(.name = "shared");
static const struct rg_image main_only = IMAGE(.name = "main only");
static const struct rg_image async_out = IMAGE(.name = "async out");
static const struct rg_image main_out = IMAGE(.name = "main out");

#define STORES(of, at) \
    { \
        &(of), .access = RG_STORAGE_WRITE, .binding = (at) \
    }
#define LOADS(of, at) \
    { \
        &(of), .access = RG_STORAGE_READ, .binding = (at) \
    }
#define ON_COMPUTE(title, ...) \
    { \
        .name = (title), .kind = RG_COMPUTE, .comp = &small_graph_shader, \
        .record = small_graph_record, .queue = RG_QUEUE_COMPUTE, .uses = RG_USES(__VA_ARGS__) \
    }

/* "clear" overwrites what "async" reads in the same layout, and may only do so after it; the
 * barrier of "read" must not be recorded with that of "async", nor the transition for "clear" with
 * it. */
static const struct rg_pass rows[] = {
    COMPUTE("store", STORES(shared, 0), STORES(main_only, 1)),
    ON_COMPUTE("async", LOADS(shared, 0), STORES(async_out, 1)),
    COMPUTE("read", LOADS(main_only, 0), STORES(main_out, 1)),
    COPY("clear", { &shared, .access = RG_COPY_DST }),
    COMPUTE("last", LOADS(shared, 0), { &main_out, .access = RG_STORAGE_READ_WRITE, .binding = 1 }),
};

static struct rg_plan *compile(VkFlags queues)
{
    static const struct rg_technique technique = RG_TECHNIQUE("test", rows);
    static const struct rg_output outputs[] = { { &async_out, .access = RG_SAMPLED },
                                                { &main_out, .access = RG_SAMPLED } };
    const struct rg_compile_params params = {
        .techniques = (const struct rg_technique *const[]){ &technique },
        .technique_count = 1,
        .view = { SMALL_GRAPH_SIZE, SMALL_GRAPH_SIZE },
        .outputs = outputs,
        .output_count = 2,
        .queues = queues,
    };
    struct rg_plan *plan = rg_compile(&params);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(hazard_check(plan, &params, stderr), 0);
    return plan;
}

static void check(const struct rg_plan *plan, uint32_t index, struct rg_submission expected)
{
    const struct rg_submission *s = &plan->submissions[index];
    assert_int_equal(s->queue, expected.queue);
    assert_int_equal(s->first_pass, expected.first_pass);
    assert_int_equal(s->pass_count, expected.pass_count);
    for (uint32_t i = 0; i < RG_QUEUE_COUNT; i++)
        assert_int_equal(s->waits[i], expected.waits[i]);
}

static void test_waits(void **state)
{
    (void)state;
    struct rg_plan *plan = compile(1 << RG_QUEUE_COMPUTE);
    assert_int_equal(plan->submission_count, 6);
    check(plan, 0, (struct rg_submission){ RG_QUEUE_MAIN, 0, 0, { 0 } });
    check(plan, 1, (struct rg_submission){ RG_QUEUE_MAIN, 0, 1, { 0 } });
    check(plan, 2, (struct rg_submission){ RG_QUEUE_COMPUTE, 1, 1, { [RG_QUEUE_MAIN] = 2 } });
    check(plan, 3, (struct rg_submission){ RG_QUEUE_MAIN, 2, 1, { 0 } });
    check(plan, 4, (struct rg_submission){ RG_QUEUE_MAIN, 3, 2, { [RG_QUEUE_COMPUTE] = 3 } });
    check(plan, 5, (struct rg_submission){ RG_QUEUE_MAIN, 5, 0, { [RG_QUEUE_COMPUTE] = 3 } });
    /* only the main queue's images are in the block */
    assert_int_equal(plan->memory_used, 2 * SMALL_GRAPH_BYTES);
    assert_int_equal(plan->memory_persistent, 2 * SMALL_GRAPH_BYTES);
    rg_plan_destroy(plan);
}

static void test_one_queue_by_default(void **state)
{
    (void)state;
    const VkFlags without[] = { 0, 1 << RG_QUEUE_TRANSFER };
    for (int i = 0; i < 2; i++) {
        struct rg_plan *plan = compile(without[i]);
        assert_int_equal(plan->submission_count, 0);
        assert_int_equal(plan->memory_persistent, 0);
        rg_plan_destroy(plan);
    }
}

/* ---- imports ---- */

static bool sometimes(const struct rg_frame *frame, uint32_t repetition)
{
    (void)frame;
    (void)repetition;
    return true; /* the hazard checker also simulates frames that skip the row */
}

static const struct rg_buffer commands = { "commands", 64 };
static const struct rg_pass import_rows[] = {
    { .name = "fill",
      .kind = RG_TRANSFER,
      .queue = RG_QUEUE_TRANSFER,
      .when = sometimes,
      .record = small_graph_record,
      .uses = RG_USES({ .buffer = &commands, .access = RG_COPY_DST }) },
    COMPUTE("count", { .buffer = &commands, .access = RG_INDIRECT }, STORES(main_out, 0)),
};

/* If "fill" is skipped, "count" reads what the application wrote. If not, the application may only
 * overwrite the commands after "count" has read them. */
static void test_import_returns(void **state)
{
    (void)state;
    static const struct rg_technique technique = RG_TECHNIQUE("test", import_rows);
    const struct rg_import import = { .buffer = &commands, .access = RG_COPY_DST };
    const struct rg_output output = { &main_out, .access = RG_SAMPLED };
    const struct rg_compile_params params = {
        .techniques = (const struct rg_technique *const[]){ &technique },
        .technique_count = 1,
        .view = { SMALL_GRAPH_SIZE, SMALL_GRAPH_SIZE },
        .imports = &import,
        .import_count = 1,
        .outputs = &output,
        .output_count = 1,
        .queues = 1 << RG_QUEUE_TRANSFER,
    };
    struct rg_plan *plan = rg_compile(&params);
    assert_non_null(plan);
    assert_int_equal(plan->fault_count, 0);
    assert_int_equal(hazard_check(plan, &params, stderr), 0);
    assert_int_equal(plan->submission_count, 4);
    rg_plan_destroy(plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_waits),
        cmocka_unit_test(test_one_queue_by_default),
        cmocka_unit_test(test_import_returns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
