/* damage.h: mutation testing of plan checkers: copies of a plan with one injected fault each. */
#ifndef TESTS_DAMAGE_H
#define TESTS_DAMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "graph/rg.h"

/* A copy of a plan whose arrays can be modified. */
struct damage_copy {
    const struct rg_compile_params *params;
    struct rg_plan plan;
    struct rg_plan_pass *passes;
    struct rg_plan_image *images;
    struct rg_plan_buffer *buffers;
    struct rg_barrier *barriers;
    struct rg_plan_use *uses;
    struct rg_plan_target *colors;
    struct rg_block *blocks;
};

size_t damage_count(void); /* number of mutation operators */
const char *damage_name(size_t damage);

/*
 * Copies `plan` and applies mutation operator `damage` at the next position, starting at *next
 * (initially 0), where the fault provably breaks the plan. Advances *next. Returns false, without a
 * copy, if no such position is left.
 */
bool damage_init(struct damage_copy *c, const struct rg_plan *plan,
                 const struct rg_compile_params *params, size_t damage, uint32_t *next);

void damage_finish(struct damage_copy *c);

#endif
