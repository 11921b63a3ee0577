/*
 * yardstick.h: the bare passes over a graph's accesses that any compiler of render graphs makes.
 *
 * It says how fast they are on a machine: every access is copied through a call of its own into
 * flat arrays; then come culling, lifetimes, transitions, the fewest batches of them for this
 * order, and a place for every image: first fit, in order of time. Nothing is checked and nothing
 * allocated. It is there to measure by and for nothing else.
 */
#ifndef TESTS_YARDSTICK_H
#define TESTS_YARDSTICK_H

#include <stdbool.h>
#include <stdint.h>

#include "tests/bench/graph/synthetic.h"

struct yardstick_access {
    uint32_t image;
    uint16_t stage, access;
};

struct yardstick_pass {
    uint32_t first_access, access_count;
};

struct yardstick {
    struct yardstick_access *accesses;
    uint32_t access_count;
    struct yardstick_pass *passes;
    uint32_t pass_count;
    uint64_t *sizes; /* bytes, of the images */
    uint32_t image_count;
    char *memory; /* for compiling */
};

struct yardstick_result {
    uint32_t live_count;         /* passes */
    uint32_t transition_count;   /* of images */
    uint32_t batch_count;        /* one for each living pass that needs a transition */
    uint32_t fewest_batch_count; /* without those after the last pass */
    uint32_t depth;              /* passes in the longest chain of reads and writes */
    uint64_t memory_used;        /* bytes */
};

/* Memory for this graph; false if it is short. */
bool yardstick_init(struct yardstick *yardstick, const struct synthetic *graph);
void yardstick_finish(struct yardstick *yardstick);

void yardstick_declare(struct yardstick *yardstick, const struct synthetic *graph);
struct yardstick_result yardstick_compile(const struct yardstick *yardstick);

#endif
