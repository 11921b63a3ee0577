/*
 * row_builder.h: memory for rows that a technique makes when it is chosen.
 *
 * Ownership: what the functions return lives until row_builder_finish().
 * Errors:    NULL when memory is short; `failed` then stays true, so that callers may return no
 *            rows and go on.
 */
#ifndef FIRN_TECH_ROW_BUILDER_H
#define FIRN_TECH_ROW_BUILDER_H

#include "graph/rg.h"

struct row_builder {
    struct row_block *blocks; /* of memory, newest first */
    bool failed;
};

/* Memory for any object, zeroed. */
void *row_builder_alloc(struct row_builder *builder, size_t size);

/* A copy of a table of rows, to be changed. */
struct rg_pass *row_builder_rows(struct row_builder *builder, const struct rg_pass *table,
                                 size_t count);

/* "PREFIX.NAME" */
const char *row_builder_name(struct row_builder *builder, const char *prefix, const char *name);

/* A target alone, for rows with one colour target. */
const struct rg_target *row_builder_target(struct row_builder *builder, struct rg_target target);

/* The uses of several lists, each of which ends at {0} or is NULL, one after another. */
const struct rg_use *row_builder_uses(struct row_builder *builder,
                                      const struct rg_use *const *lists, size_t count);

void row_builder_finish(struct row_builder *builder); /* {0} is fine */

#endif
