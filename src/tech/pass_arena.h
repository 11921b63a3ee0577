/*
 * pass_arena.h: arena allocator for pass tables that a technique builds at run time. The builder
 * (struct pass_arena) owns all results. If out of memory, functions set `failed` and return NULL.
 * Callers may then return no passes, because the builder's owner handles the error.
 */
#ifndef FIRN_TECH_PASS_ARENA_H
#define FIRN_TECH_PASS_ARENA_H

#include "graph/rg.h"

struct pass_arena {
    struct pass_block *blocks; /* list of memory blocks, newest first */
    bool failed;
};

/* Returns zeroed memory of `size` bytes, aligned for any object. */
void *pass_arena_alloc(struct pass_arena *builder, size_t size);

/* Returns a writable copy of a table of passes. */
struct rg_pass *pass_arena_copy_passes(struct pass_arena *builder, const struct rg_pass *table,
                                       size_t count);

/* Returns the string "PREFIX.NAME". */
const char *pass_arena_name(struct pass_arena *builder, const char *prefix, const char *name);

/* Returns a table that contains one colour target. */
const struct rg_target *pass_arena_target(struct pass_arena *builder, struct rg_target target);

/* Return writable copies of a pass's targets and uses. An empty table gives NULL. */
struct rg_target *pass_arena_copy_targets(struct pass_arena *builder,
                                          const struct rg_target *targets, uint32_t count);
struct rg_use *pass_arena_copy_uses(struct pass_arena *builder, const struct rg_use *uses);

/* Returns `count` lists of uses joined into one. A list is NULL or ends at an empty use {0}. */
const struct rg_use *pass_arena_join_uses(struct pass_arena *builder,
                                          const struct rg_use *const *lists, size_t count);

void pass_arena_finish(struct pass_arena *builder); /* {0} is fine */

#endif
