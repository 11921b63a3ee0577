/*
 * bench.c: CPU time of rg_compile() per row of the tables, over random graphs.
 *
 * Each graph is compiled in memory that the caller provides; filling the tables does not count.
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "graph/rg.h"
#include "tests/support/random_graph.h"

enum {
    GRAPHS = 2500,
    ROUNDS = 8, /* the last one counts: caches are warm */
    MEMORY_SIZE = 16 << 20,
};

static size_t row_count(const struct rg_compile_params *params)
{
    size_t count = 0;
    for (size_t i = 0; i < params->technique_count; i++)
        count += params->techniques[i]->pass_count;
    return count;
}

/* Compiles a graph ROUNDS times. Returns the CPU time of the last round, in seconds. */
static double compile_time(const struct rg_compile_params *params)
{
    struct timespec begin, end;
    for (int round = 0; round < ROUNDS; round++) {
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
        struct rg_plan *plan = rg_compile(params);
        rg_plan_destroy(plan);
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    }
    return (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
}

int main(void)
{
    void *memory = malloc(MEMORY_SIZE);
    double seconds[2] = { 0.0 };
    size_t rows[2] = { 0 };
    for (uint64_t seed = 0; memory && seed < GRAPHS; seed++) {
        struct random_graph graph;
        if (!random_graph_init(&graph, seed, 0))
            return EXIT_FAILURE;
        graph.params.memory = memory;
        graph.params.memory_size = MEMORY_SIZE;
        const size_t count = row_count(&graph.params);
        const int is_long = count >= 100;
        seconds[is_long] += compile_time(&graph.params);
        rows[is_long] += count;
        random_graph_finish(&graph);
    }
    free(memory);
    printf("below 100 rows: %.3f us a row\n100 rows or more: %.3f us a row\n",
           1e6 * seconds[0] / (double)rows[0], 1e6 * seconds[1] / (double)rows[1]);
    return memory ? EXIT_SUCCESS : EXIT_FAILURE;
}
