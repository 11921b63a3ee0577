/*
 * measure.h: what the render graph costs, measured beside the yardstick.
 */
#ifndef TESTS_MEASURE_H
#define TESTS_MEASURE_H

#include <stdbool.h>
#include <stdint.h>

#include "graph/rg.h"
#include "tests/bench/graph/synthetic.h"

enum {
    MEASURE_SHARING_COUNT = RG_SHARE_NOTHING + 1,
    MEASURE_SEED = 12345,
};

struct measure_time {
    double median, min; /* microseconds */
};

struct measure_times {
    struct measure_time setup, compile;
    struct measure_time total; /* of both: the median of sums, not the sum of medians */
};

/*
 * In turn, each run finds caches and branch predictors full of the others' work, as in a program
 * that compiles a graph now and then. In a row, it finds its own, as in a loop around one of them.
 */
enum measure_order {
    MEASURE_IN_TURN,  /* the yardstick and each way to share alternate, run by run */
    MEASURE_IN_A_ROW, /* 16 runs of one, the last 8 of which count, then of the next */
    MEASURE_ORDER_COUNT,
};

/* Of one way to share memory. */
struct measure_sharing {
    struct measure_times times[MEASURE_ORDER_COUNT];
    uint64_t allocation_count; /* of one compilation in `arena_size` bytes given */
    uint32_t live_count;       /* passes */
    uint32_t batch_count;      /* without the one after the last pass */
    uint64_t arena_size;       /* bytes, as are all below */
    uint64_t memory_used, memory_bound, memory_least, memory_without_aliasing;
};

/* What the passes of a graph are: see synthetic.h. */
enum measure_shape {
    MEASURE_COMPUTE,
    MEASURE_FRAME,
    MEASURE_SHAPE_COUNT,
};

struct measure_graph {
    enum measure_shape shape;
    uint32_t pass_count, repetitions;
    uint32_t live_count;            /* passes, as the graph itself says */
    struct synthetic_memory memory; /* the same; only of MEASURE_COMPUTE */
    uint32_t fewest_batch_count;    /* as the yardstick counts them */
    struct measure_times yardstick[MEASURE_ORDER_COUNT];
    struct measure_sharing sharing[MEASURE_SHARING_COUNT]; /* by enum rg_sharing */
};

/*
 * Sets up and compiles the graph of this length, `repetitions` times in each order; with 0 nothing
 * is timed. False, with a line on stderr, if memory is short or a plan has faults.
 */
bool measure_graph(struct measure_graph *result, enum measure_shape shape, uint32_t pass_count,
                   uint32_t repetitions);

struct measure_ratio {
    double mean, worst;
};

/* How well the images of graphs of one length are packed, over many seeds. */
struct measure_packing {
    uint32_t pass_count, graph_count;

    struct {
        struct measure_ratio used_to_bound, used_to_least;
    } sharing[MEASURE_SHARING_COUNT];
};

/* Seeds 1001 to 1200. False as above. */
bool measure_packing(struct measure_packing *result, uint32_t pass_count);

double measure_divide(uint64_t a, uint64_t b); /* 0 where b is */

#endif
