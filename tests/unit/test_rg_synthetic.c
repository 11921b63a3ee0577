/* What the compiler makes of made-up graphs of 10 to 10000 passes: no pass, batch or allocation too
 * many, and memory packed about as tightly as it can be. */
#include "tests/bench/graph/measure.h"
#include "tests/bench/graph/yardstick.h"
#include "tests/support/assertions.h"

/* Of MEASURE_SEED, counted by another program. */
static const struct {
    uint32_t pass_count, live_count, fewest_batch_count;
} known[] = {
    { 10, 8, 6 }, { 25, 20, 9 }, { 100, 80, 26 }, { 1000, 800, 224 }, { 10000, 8000, 2205 },
};

enum {
    KNOWN_COUNT = sizeof(known) / sizeof(known[0])
};

static void test_the_graphs_are_the_known_ones(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < KNOWN_COUNT; i++) {
        struct synthetic graph;
        struct yardstick yardstick;
        assert_true(synthetic_init(&graph, known[i].pass_count, MEASURE_SEED));
        assert_true(yardstick_init(&yardstick, &graph));
        yardstick_declare(&yardstick, &graph);
        struct yardstick_result result = yardstick_compile(&yardstick);
        assert_int_equal(graph.live_count, known[i].live_count);
        assert_int_equal(result.live_count, known[i].live_count);
        assert_int_equal(result.fewest_batch_count, known[i].fewest_batch_count);
        yardstick_finish(&yardstick);
        synthetic_finish(&graph);
    }
}

/* ---- plans ---- */

typedef void check_fn(const struct measure_graph *graph, enum rg_sharing sharing);

static void check_each_plan(check_fn *check)
{
    for (uint32_t i = 0; i < KNOWN_COUNT; i++) {
        struct measure_graph graph;
        assert_true(measure_graph(&graph, MEASURE_COMPUTE, known[i].pass_count, 0));
        for (uint32_t k = 0; k < MEASURE_SHARING_COUNT; k++)
            check(&graph, (enum rg_sharing)k);
    }
}

static void check_equal(const struct measure_graph *graph, enum rg_sharing sharing, uint64_t value,
                        uint64_t wanted)
{
    if (value != wanted)
        fail_msg("%u passes, rg_sharing %u: %llu, not %llu", graph->pass_count, (unsigned)sharing,
                 (unsigned long long)value, (unsigned long long)wanted);
}

static void check_passes(const struct measure_graph *graph, enum rg_sharing sharing)
{
    check_equal(graph, sharing, graph->sharing[sharing].live_count, graph->live_count);
}

static void test_what_nobody_needs_is_culled(void **state)
{
    (void)state;
    check_each_plan(check_passes);
}

static void check_batches(const struct measure_graph *graph, enum rg_sharing sharing)
{
    if (sharing != RG_SHARE_LEAST_MEMORY)
        check_equal(graph, sharing, graph->sharing[sharing].batch_count, graph->fewest_batch_count);
}

static void test_batches_are_the_fewest(void **state)
{
    (void)state;
    check_each_plan(check_batches);
}

static void check_allocations(const struct measure_graph *graph, enum rg_sharing sharing)
{
    check_equal(graph, sharing, graph->sharing[sharing].allocation_count, 0);
}

static void test_nothing_is_allocated_in_memory_given(void **state)
{
    (void)state;
    check_each_plan(check_allocations);
}

/* Graphs shaped like real frames: living passes are those that the graph says, and each of them is
 * compiled in the memory given. */
static void test_frames_are_culled_and_allocate_nothing(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < KNOWN_COUNT; i++) {
        struct measure_graph graph;
        assert_true(measure_graph(&graph, MEASURE_FRAME, known[i].pass_count, 0));
        for (uint32_t k = 0; k < MEASURE_SHARING_COUNT; k++) {
            check_passes(&graph, (enum rg_sharing)k);
            check_allocations(&graph, (enum rg_sharing)k);
        }
    }
}

/* What the plan says of memory, against what the graph itself says. */
static void check_memory(const struct measure_graph *graph, enum rg_sharing sharing)
{
    const struct measure_sharing *plan = &graph->sharing[sharing];
    check_equal(graph, sharing, plan->memory_without_aliasing, graph->memory.sum);
    check_equal(graph, sharing, plan->memory_least, graph->memory.bound);
    if (sharing == RG_SHARE_LEAST_MEMORY)
        check_equal(graph, sharing, plan->memory_bound, graph->memory.bound);
    if (sharing == RG_SHARE_NOTHING)
        check_equal(graph, sharing, plan->memory_used, graph->memory.sum);
    assert_in_range(plan->memory_bound, plan->memory_least, plan->memory_used);
    assert_in_range(plan->memory_used, plan->memory_bound, plan->memory_without_aliasing);
}

static void test_memory_is_counted_right(void **state)
{
    (void)state;
    check_each_plan(check_memory);
}

/* ---- packing ---- */

static void check_packing(uint32_t pass_count, double mean, double worst)
{
    struct measure_packing packing;
    assert_true(measure_packing(&packing, pass_count));
    for (uint32_t i = 0; i < RG_SHARE_NOTHING; i++) {
        const struct measure_ratio *ratio = &packing.sharing[i].used_to_bound;
        if (!(ratio->worst >= 1 && ratio->mean <= mean && ratio->worst <= worst))
            fail_msg("%u passes, rg_sharing %u: %.4f of the bound, at worst %.4f", pass_count, i,
                     ratio->mean, ratio->worst);
    }
}

static void test_20_passes_are_packed_within_2_percent(void **state)
{
    (void)state;
    check_packing(20, 1.02, 1.15);
}

static void test_100_passes_are_packed_within_5_percent(void **state)
{
    (void)state;
    check_packing(100, 1.05, 1.15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_graphs_are_the_known_ones),
        cmocka_unit_test(test_what_nobody_needs_is_culled),
        cmocka_unit_test(test_batches_are_the_fewest),
        cmocka_unit_test(test_nothing_is_allocated_in_memory_given),
        cmocka_unit_test(test_frames_are_culled_and_allocate_nothing),
        cmocka_unit_test(test_memory_is_counted_right),
        cmocka_unit_test(test_20_passes_are_packed_within_2_percent),
        cmocka_unit_test(test_100_passes_are_packed_within_5_percent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
