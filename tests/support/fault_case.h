/*
 * fault_case.h: small tables with one fault each, compiled and compared with what is expected.
 */
#ifndef TESTS_FAULT_CASE_H
#define TESTS_FAULT_CASE_H

#include "graph/rg.h"
#include "tests/support/small_graph.h"

enum {
    FAULT_CASE_VIEW = 64, /* texels of the view */
    FAULT_CASE_ROWS = 2,
};

#define FAULT_CASE_WILD UINT32_MAX

extern const struct rg_image fault_case_picture, fault_case_other;

/* Rows that say little more than one resource; ALSO reads it and writes another. */
#define FILL(to)    DRAW("draw", .color = RG_TARGETS({ CLEARED(to) }))
#define COPY_TO(to) COPY("copy", { .buffer = &(to), .access = RG_COPY_DST })
#define ALSO(...)   COMPUTE("compute", { WRITE_OTHER }, { __VA_ARGS__ })
#define WRITE_OTHER .image = &fault_case_other, .access = RG_STORAGE_WRITE, .binding = 9

/*
 * Before the rows of a case, in a technique of its own, a good row writes `picture`, which is the
 * output unless the case has outputs. One fault is expected, in the last row if it lies in a row.
 */
struct fault_case {
    enum rg_error error;
    const char *resource; /* that the fault names; NULL: none */
    bool row;             /* it lies in a row */
    uint32_t row_count;
    struct rg_pass rows[FAULT_CASE_ROWS];
    struct rg_output outputs[2];
    struct rg_import imports[2];
    const struct rg_device *device;
    bool no_output, no_view, nameless_technique;
    void (*edit)(struct rg_compile_params *params); /* breaks them; NULL: as they are */
    const char *text; /* the line expected, instead of the names; NULL: they are compared */
};

/* A fault in the only row, of a resource (NULL: none). */
#define ROW(kind, name, ...) \
    .error = (kind), .resource = (name), .row = true, .row_count = 1, .rows = { __VA_ARGS__ }
/* A fault outside the rows, which a good or bad row may lead to. */
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

/* The plan of a case, which the caller destroys. */
struct rg_plan *fault_case_compile(const struct fault_case *fc);

/* Compiles all cases: each has the fault expected and no other. */
void fault_case_check(const struct fault_cases *tables, size_t table_count,
                      bool provoked[RG_ERROR_COUNT]);

bool fault_case_same_text(const char *a, const char *b); /* may be NULL */

#endif
