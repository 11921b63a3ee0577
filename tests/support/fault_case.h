/* fault_case.h: small graphs with one fault each, compiled and compared with the expected fault. */
#ifndef TESTS_FAULT_CASE_H
#define TESTS_FAULT_CASE_H

#include "graph/rg.h"
#include "tests/support/small_graph.h"

enum {
    FAULT_CASE_VIEW = 64, /* width and height of the view, pixels */
    FAULT_CASE_ROWS = 2,
};

#define FAULT_CASE_WILD UINT32_MAX

extern const struct rg_image fault_case_picture, fault_case_other;

/* Rows with a single resource of interest; ALSO reads it and writes another image. */
#define FILL(to)    DRAW("draw", .color = RG_TARGETS({ CLEARED(to) }))
#define COPY_TO(to) COPY("copy", { .buffer = &(to), .access = RG_COPY_DST })
#define ALSO(...)   COMPUTE("compute", { WRITE_OTHER }, { __VA_ARGS__ })
#define WRITE_OTHER .image = &fault_case_other, .access = RG_STORAGE_WRITE, .binding = 9

/*
 * One expected fault and the tables that provoke it.
 *
 * A valid technique before the case's rows writes `picture`, which is the output unless the case
 * has outputs. A fault in a row is expected in the last row.
 */
struct fault_case {
    enum rg_error error;
    const char *resource; /* name in the fault; NULL if it names none */
    bool row;             /* the fault is located in a row */
    uint32_t row_count;
    struct rg_pass rows[FAULT_CASE_ROWS];
    struct rg_output outputs[2];
    struct rg_import imports[2];
    const struct rg_device *device;
    bool no_output, no_view, nameless_technique;
    void (*edit)(struct rg_compile_params *params); /* modifies the parameters; may be NULL */
    const char *text; /* expected message; NULL to compare the fault's names instead */
};

/* A fault in the only row, for the resource `name` (may be NULL). */
#define ROW(kind, name, ...) \
    .error = (kind), .resource = (name), .row = true, .row_count = 1, .rows = { __VA_ARGS__ }
/* A fault outside the rows, with any row that provokes it. */
#define AROUND(kind, name, ...) \
    .error = (kind), .resource = (name), .row_count = 1, .rows = { __VA_ARGS__ }
#define OUTPUT(kind, name, ...) .error = (kind), .resource = (name), .outputs = { __VA_ARGS__ }
#define IMPORT(kind, name, ...) .error = (kind), .resource = (name), .imports = { __VA_ARGS__ }

#define FAULT_CASES(table) \
    { \
        table, sizeof(table) / sizeof((table)[0]) \
    }

struct fault_cases {
    const struct fault_case *cases;
    size_t count;
};

/* Compiles a case; the caller destroys the plan. */
struct rg_plan *fault_case_compile(const struct fault_case *fc);

/* Compiles all cases; fails unless each has exactly its expected fault. Marks errors `provoked`. */
void fault_case_check(const struct fault_cases *tables, size_t table_count,
                      bool provoked[RG_ERROR_COUNT]);

bool fault_case_same_text(const char *a, const char *b); /* true if equal or both NULL */

#endif
