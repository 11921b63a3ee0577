/* plan_mutation.h: mutation testing of plan checkers: plan copies with one injected fault each. */
#ifndef TESTS_SUPPORT_PLAN_MUTATION_H
#define TESTS_SUPPORT_PLAN_MUTATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "graph/rg.h"

/* A copy of a plan whose arrays can be modified. */
struct plan_mutant {
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

size_t plan_mutation_count(void); /* number of mutation operators */
const char *plan_mutation_name(size_t damage);

/*
 * Copies `plan` and applies mutation operator `damage` at the next position, starting at *next
 * (initially 0), where the fault provably breaks the plan. Advances *next. Returns false, without a
 * copy, if no such position is left.
 */
bool plan_mutation_init(struct plan_mutant *c, const struct rg_plan *plan,
                        const struct rg_compile_params *params, size_t damage, uint32_t *next);

void plan_mutation_finish(struct plan_mutant *c);

#endif
