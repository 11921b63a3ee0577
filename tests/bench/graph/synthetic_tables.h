/*
 * synthetic_tables.h: a synthetic graph as tables for rg_compile(): passes that sample what they
 * read and store, or draw, what they write; image 0 is imported, and shown afterwards.
 */
#ifndef TESTS_SYNTHETIC_TABLES_H
#define TESTS_SYNTHETIC_TABLES_H

#include "graph/rg.h"
#include "tests/bench/graph/synthetic.h"

/* Stays where it is: its parts point to each other. */
struct synthetic_tables {
    struct rg_image *images;
    struct rg_pass *passes;
    struct rg_use *uses;       /* of all passes, each pass's ended by a row of zeros */
    struct rg_target *targets; /* colour targets of all passes */
    struct rg_technique technique;
    const struct rg_technique *techniques[1];
    struct rg_import import;
    struct rg_output output;
    struct rg_compile_params params;
};

/* Memory for this graph; false if it is short. */
bool synthetic_tables_init(struct synthetic_tables *tables, const struct synthetic *graph);
void synthetic_tables_finish(struct synthetic_tables *tables);

/* Fills every row; `params` may be compiled then. Borrows the graph's names. */
void synthetic_tables_fill(struct synthetic_tables *tables, const struct synthetic *graph);

#endif
