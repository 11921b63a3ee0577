/*
 * random_graph.h: generator of random graphs, valid by construction, for tests of the compiler.
 *
 * Equal seeds give equal tables. They use all kinds of passes, loads, ranges, repeats, formats,
 * samples, resolves, conditions, history, imports and outputs, and some passes that no output
 * needs; no pass reads unwritten texels or uses the same texels twice. Most tables have a handful
 * of passes, a few have hundreds.
 */
#ifndef TESTS_RANDOM_GRAPH_H
#define TESTS_RANDOM_GRAPH_H

#include <stdint.h>

#include "graph/rg.h"

struct random_graph {
    struct rg_compile_params params; /* points into `tables` */
    void *tables;
};

/*
 * Generates a graph of at most `most_passes` passes (0 for no limit), and one more if no other pass
 * writes an output. Returns false when out of memory. The graph must not be moved afterwards.
 */
bool random_graph_init(struct random_graph *graph, uint64_t seed, uint32_t most_passes);

void random_graph_finish(struct random_graph *graph);

#endif
