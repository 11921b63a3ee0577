/*
 * damage.h: copies of plans with one injected fault each, to test whether a checker detects it.
 */
#ifndef TESTS_DAMAGE_H
#define TESTS_DAMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "graph/rg.h"

/* A plan whose arrays may be changed. */
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

size_t damage_count(void); /* kinds of damage */
const char *damage_name(size_t damage);

/*
 * Copies the plan of `params` and damages it at the next place where this kind of damage breaks
 * something for certain, from *next on, which is 0 at first. Returns false, without a copy, when
 * there is none left.
 */
bool damage_init(struct damage_copy *c, const struct rg_plan *plan,
                 const struct rg_compile_params *params, size_t damage, uint32_t *next);

void damage_finish(struct damage_copy *c);

#endif
