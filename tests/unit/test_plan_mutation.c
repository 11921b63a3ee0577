/* The checker of plans finds every damage done to plans of random graphs. */
#include <stdio.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/hazard_checker.h"
#include "tests/support/plan_mutation.h"
#include "tests/support/random_graph.h"

enum {
    GRAPHS = 200,
    MOST_PASSES = 20, /* rows of a graph that is damaged */
    DAMAGES_MOST = 64,
    LEAST_DONE = 10, /* places of each kind of damage */
    MOST_DONE = 100,
};

/* Damages one plan at every place; adds how often, and how often that was found. */
static void damage_plan(const struct rg_plan *plan, const struct rg_compile_params *params,
                        size_t damage, uint32_t *done, uint32_t *found)
{
    struct plan_mutant copy;
    for (uint32_t next = 0;
         *done < MOST_DONE && plan_mutation_init(&copy, plan, params, damage, &next);
         plan_mutation_finish(&copy)) {
        bool is_found = hazard_check(&copy.plan, params, NULL) != 0;
        if (!is_found && *found == *done)
            printf("%s is not found at place %u of:\n", plan_mutation_name(damage), next - 1);
        if (!is_found && *found == *done)
            rg_dump(plan, stdout);
        *found += is_found;
        ++*done;
    }
}

static void test_damage_is_found(void **state)
{
    uint32_t done[DAMAGES_MOST] = { 0 }, found[DAMAGES_MOST] = { 0 };
    (void)state;
    assert_true(plan_mutation_count() <= DAMAGES_MOST);
    for (uint64_t seed = 0; seed < GRAPHS; seed++) {
        struct random_graph graph;
        assert_true(random_graph_init(&graph, seed, MOST_PASSES));
        struct rg_plan *plan = rg_compile(&graph.params);
        assert_non_null(plan);
        assert_int_equal(plan->fault_count, 0);
        for (size_t i = 0; i < plan_mutation_count(); i++)
            damage_plan(plan, &graph.params, i, &done[i], &found[i]);
        rg_plan_destroy(plan);
        random_graph_finish(&graph);
    }
    for (size_t i = 0; i < plan_mutation_count(); i++) {
        printf("%s: found %u of %u\n", plan_mutation_name(i), found[i], done[i]);
        assert_true(done[i] >= LEAST_DONE);
        assert_int_equal(found[i], done[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_damage_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
