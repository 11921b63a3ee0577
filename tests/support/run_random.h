/*
 * run_random.h: random tables that a device can run, with integer formats.
 *
 * Equal seeds give equal tables. They have all kinds of passes, loads, ranges, repeats and buffers,
 * and some passes that no output needs, but no imports and no resolves. Their results are defined
 * to the last bit; interpret.h computes them.
 */
#ifndef TESTS_RUN_RANDOM_H
#define TESTS_RUN_RANDOM_H

#include "tests/support/interpret.h"
#include "tests/support/run_graph.h"

/* The set that some rows name; struct rg_frame has it. */
extern const struct rg_set run_random_own;

/* Features of the graph that the tables may use. */
enum {
    RUN_RANDOM_HISTORY = 1 << 0,    /* persistent images and buffers */
    RUN_RANDOM_CONDITIONS = 1 << 1, /* passes that do not run in every frame */
};

struct run_random {
    uint64_t seed;
    struct run_params params;       /* of the way to run, too; points into *memory */
    struct interpret_tables tables; /* the same */
    void *memory;
};

/* Returns false if memory is short. */
bool run_random_init(struct run_random *graph, uint64_t seed, unsigned features);
void run_random_finish(struct run_random *graph);

/* What the CPU writes into an upload buffer before a frame. */
void run_random_fill(const struct run_random *graph, const struct rg_buffer *buffer, uint32_t frame,
                     uint32_t *words);

/* Records any row. Where the plan says that nobody needs what a pass leaves in a target, it is
 * overwritten, as a device may do. */
rg_record_fn run_random_record;

#endif
