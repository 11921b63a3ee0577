/* Plans of random graphs stand before the checker, whatever they share and wherever they lie. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "graph/rg.h"
#include "tests/support/assertions.h"
#include "tests/support/hazard_checker.h"
#include "tests/support/random_graph.h"

enum {
    REPORTED = 5, /* seeds whose findings are written out */
    DUMP_SIZE = 1 << 20,
};

/* First seed and count. */
struct seeds {
    uint64_t first, count;
};

/* ---- the linker sends calls of malloc() to __wrap_malloc(), and of __real_malloc() to it ---- */

static uint64_t allocation_count;

/* the linker's names NOLINTBEGIN(readability-identifier-naming) */
void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *memory, size_t size);

void *__wrap_malloc(size_t size)
{
    allocation_count++;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t n, size_t size)
{
    allocation_count++;
    return __real_calloc(n, size);
}

void *__wrap_realloc(void *memory, size_t size)
{
    allocation_count++;
    return __real_realloc(memory, size);
}

/* NOLINTEND(readability-identifier-naming) */

/* ---- plans ---- */

static struct rg_plan *compile(const struct rg_compile_params *params)
{
    struct rg_plan *plan = rg_compile(params);
    assert_non_null(plan);
    return plan;
}

static bool is_right(const struct rg_plan *plan, const struct rg_compile_params *params,
                     FILE *report)
{
    for (uint32_t i = 0; report && i < plan->fault_count; i++) {
        char text[256];
        rg_fault_text(&plan->faults[i], text, sizeof(text));
        fprintf(report, "%s\n", text);
    }
    return hazard_check(plan, params, report) == 0;
}

/* Returns true if the plans with and without aliasing are valid, have equally many barrier batches,
 * and aliasing takes no more memory. */
static bool is_shared_well(const struct rg_compile_params *params, FILE *report)
{
    struct rg_plan *plans[2];
    bool right = true;
    for (uint32_t i = 0; i < 2; i++) {
        struct rg_compile_params other = *params;
        other.sharing = (enum rg_sharing)i;
        plans[i] = compile(&other);
        right = is_right(plans[i], &other, report) && right;
    }
    const struct rg_plan *fewest = plans[RG_SHARE_FEWEST_BATCHES], *apart = plans[RG_SHARE_NOTHING];
    bool promised =
        fewest->batch_count == apart->batch_count && fewest->memory_used <= apart->memory_used;
    if (right && !promised && report)
        for (uint32_t i = 0; i < 2; i++)
            fprintf(report, "sharing %u: batches %u, bytes %ju, bound %ju\n", i,
                    plans[i]->batch_count, (uintmax_t)plans[i]->memory_used,
                    (uintmax_t)plans[i]->memory_bound);
    for (uint32_t i = 0; i < 2; i++)
        rg_plan_destroy(plans[i]);
    return right && promised;
}

static size_t dump(const struct rg_plan *plan, char *text, size_t size)
{
    FILE *file = fmemopen(text, size, "w");
    assert_non_null(file);
    rg_dump(plan, file);
    long length = ftell(file);
    fclose(file);
    return length < 0 ? 0 : (size_t)length;
}

/* Returns true if compiling into the caller's memory gives the same plan: with none, too little,
 * and exactly enough memory. */
static bool is_same_in_arena(const struct rg_plan *plan, const struct rg_compile_params *params,
                             uint64_t seed, FILE *report)
{
    struct rg_compile_params other = *params;
    other.memory_size = seed % 3 == 0   ? plan->arena_size
                        : seed % 3 == 1 ? plan->arena_size * (size_t)(seed % 97) / 97
                                        : 0;
    other.memory = malloc(other.memory_size + 1);
    char *texts[] = { malloc(DUMP_SIZE), malloc(DUMP_SIZE) };
    assert_true(other.memory && texts[0] && texts[1]);
    ((unsigned char *)other.memory)[other.memory_size] = 0xa5;
    const uint64_t allocations_before = allocation_count;
    struct rg_plan *again = compile(&other);
    const bool allocates = allocation_count > allocations_before;
    size_t length = dump(plan, texts[0], DUMP_SIZE);
    bool same = length == dump(again, texts[1], DUMP_SIZE) && !memcmp(texts[0], texts[1], length) &&
                again->arena_size == plan->arena_size &&
                ((unsigned char *)other.memory)[other.memory_size] == 0xa5;
    /* with enough of it, the plan lies there, and nothing else is allocated */
    if (other.memory_size == plan->arena_size)
        same = same && !allocates && (char *)again >= (char *)other.memory &&
               (char *)(again + 1) <= (char *)other.memory + other.memory_size;
    bool right = is_right(again, &other, report);
    if (!same && report)
        fprintf(report, "with %zu bytes of the %zu it is another plan, or lies elsewhere\n",
                other.memory_size, plan->arena_size);
    rg_plan_destroy(again);
    free(texts[0]);
    free(texts[1]);
    free(other.memory);
    return same && right;
}

static void test_random_graphs(void **state)
{
    const struct seeds *seeds = *state;
    uint32_t bad = 0;
    for (uint64_t seed = seeds->first; seed < seeds->first + seeds->count; seed++) {
        FILE *report = bad < REPORTED ? stdout : NULL;
        struct random_graph graph;
        assert_true(random_graph_init(&graph, seed, 0));
        struct rg_plan *plan = compile(&graph.params);
        bool right = is_right(plan, &graph.params, report);
        right = right && is_shared_well(&graph.params, report) &&
                is_same_in_arena(plan, &graph.params, seed, report);
        if (!right && report) {
            printf("seed %u:\n", (unsigned)seed);
            if (plan->fault_count == 0 && plan->pass_count < 20)
                rg_dump(plan, stdout);
        }
        bad += !right;
        rg_plan_destroy(plan);
        random_graph_finish(&graph);
    }
    assert_int_equal(bad, 0);
}

int main(int argc, char **argv)
{
    struct seeds seeds = { 0, 100 };
    if (argc == 3) {
        seeds.first = strtoull(argv[1], NULL, 10);
        seeds.count = strtoull(argv[2], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_random_graphs, &seeds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
