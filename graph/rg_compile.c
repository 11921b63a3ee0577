/* rg_compile.c: the compiler's steps, in their order. */
#include <stdlib.h>
#include "graph/rg_internal.h"

/* The plan and what it lives in. */
struct owned_plan {
    struct rg_plan plan; /* first: what the caller sees */
    struct arena arena;
};

static void run(struct compiler *c)
{
    rg_check_params(c);
    rg_collect(c);
    if (c->scratch.failed)
        return;
    rg_resolve(c);
    rg_check_passes(c);
    rg_expand(c);
    if (c->scratch.failed)
        return;
    rg_check_content(c);
    if (c->fault_count || c->scratch.failed)
        return;
    rg_cull(c);
    rg_lifetimes(c);
    if (c->fault_count || c->scratch.failed)
        return;
    rg_find_tails(c);
    rg_place(c);
    rg_sync(c);
}

struct rg_plan *rg_compile(const struct rg_compile_params *params)
{
    struct owned_plan *owned = calloc(1, sizeof(*owned));
    if (!owned)
        return NULL;
    struct compiler c = {
        .params = params,
        .plan = &owned->plan,
        .arena = &owned->arena,
    };
    owned->plan.view = params->view;
    run(&c);
    owned->plan.faults = c.faults;
    owned->plan.fault_count = c.fault_count;
    owned->plan.arena_size = sizeof(*owned) + owned->arena.size;
    bool failed = c.scratch.failed || owned->arena.failed;
    arena_finish(&c.scratch);
    if (failed) {
        rg_plan_destroy(&owned->plan);
        return NULL;
    }
    return &owned->plan;
}

void rg_plan_destroy(struct rg_plan *plan)
{
    if (!plan)
        return;
    struct owned_plan *owned = (struct owned_plan *)plan;
    arena_finish(&owned->arena);
    free(owned);
}
