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

/* Passes with one access to test; the pass of ALSO writes another image as well. */
#define FILL(to)    DRAW("draw", .color = RG_TARGETS({ CLEARED(to) }))
#define COPY_TO(to) COPY("copy", { .buffer = &(to), .access = RG_COPY_DST })
#define ALSO(...)   COMPUTE("compute", { WRITE_OTHER }, { __VA_ARGS__ })
#define WRITE_OTHER .image = &fault_case_other, .access = RG_STORAGE_WRITE, .binding = 9

/*
 * An expected fault, and the graph that provokes it.
 *
 * A valid technique runs before `rows` and writes `fault_case_picture`, which is the only output
 * unless `outputs` are set. If `row` is true, the fault is expected in the last pass of `rows`.
 */
struct fault_case {
    enum rg_error error;
    const char *resource; /* name that the fault mentions, or NULL */
    bool row;             /* true if the fault is in the last pass */
    uint32_t row_count;
    struct rg_pass rows[FAULT_CASE_ROWS];
    struct rg_output outputs[2];
    struct rg_import imports[2];
    const struct rg_device *device;
    bool no_output, no_view, nameless_technique;
    void (*edit)(struct rg_compile_params *params); /* modifies the parameters; may be NULL */
    const char *text; /* expected message; if NULL, the fault's names are compared */
};

/* Case with one faulty pass; `name` is the resource that the fault mentions, or NULL. */
#define ROW(kind, name, ...) \
    .error = (kind), .resource = (name), .row = true, .row_count = 1, .rows = { __VA_ARGS__ }
/* Case with one pass whose resource is at fault; the fault names no pass. */
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

/* Fails unless every case has exactly its expected fault. Sets `provoked` for each such error. */
void fault_case_check(const struct fault_cases *tables, size_t table_count,
                      bool provoked[RG_ERROR_COUNT]);

bool fault_case_same_text(const char *a, const char *b); /* true if equal or both NULL */

#endif
