/*
 * run_random.h: generator of random graphs that a device can execute, with integer formats.
 *
 * Equal seeds give equal tables. They have all kinds of passes, loads, ranges, repeats and buffers,
 * and some passes that no output needs, but no imports and no resolves. Their results are exactly
 * defined; the reference interpreter (interpret_graph.h) computes them.
 */
#ifndef TESTS_RUN_RANDOM_H
#define TESTS_RUN_RANDOM_H

#include "tests/support/interpret_graph.h"
#include "tests/support/run_graph.h"

/* Application descriptor set that some passes use; it is bound from rg_frame.own. */
extern const struct rg_set run_random_own;

/* Optional features that the generated tables may use. */
enum {
    RUN_RANDOM_HISTORY = 1 << 0,    /* persistent images and buffers */
    RUN_RANDOM_CONDITIONS = 1 << 1, /* passes that do not run in every frame */
};

struct run_random {
    uint64_t seed;
    struct run_params params;       /* graph and run parameters; points into *memory */
    struct interpret_tables tables; /* graph for the interpreter; points into *memory */
    void *memory;
};

/* Returns false when out of memory. */
bool run_random_init(struct run_random *graph, uint64_t seed, unsigned features);
void run_random_finish(struct run_random *graph);

/* Computes the content that the host writes to an upload buffer before a frame. */
void run_random_fill(const struct run_random *graph, const struct rg_buffer *buffer, uint32_t frame,
                     uint32_t *words);

/* Records any pass. Then overwrites targets with store op DONT_CARE, as a device may do. */
rg_record_fn run_random_record;

#endif
