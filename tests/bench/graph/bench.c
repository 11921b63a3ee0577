/* bench.c: the program `meson test --benchmark graph` runs. */
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "tests/bench/graph/report.h"

enum {
    EXIT_USAGE = 2,
    MAX_PASS_COUNT = 1000000,
    MAX_REPETITIONS = 1000000,
};

struct options {
    const char *json;     /* file, or NULL */
    uint32_t repetitions; /* 0: as graph_rows says */
    uint32_t only;        /* passes; 0: all of graph_rows, and packing */
    bool help;
};

/* What is measured. */
static const struct {
    uint32_t pass_count, repetitions;
} graph_rows[] = {
    { 10, 4001 }, { 25, 2001 }, { 100, 1001 }, { 1000, 201 }, { 10000, 41 },
};

static const uint32_t packing_rows[] = { 20, 100 };

enum {
    GRAPH_COUNT = sizeof(graph_rows) / sizeof(graph_rows[0]),
    PACKING_COUNT = sizeof(packing_rows) / sizeof(packing_rows[0]),
};

_Static_assert((int)GRAPH_COUNT *MEASURE_SHAPE_COUNT <= REPORT_MAX_GRAPHS, "no room for a graph");
_Static_assert((int)PACKING_COUNT <= REPORT_MAX_PACKINGS, "no room for a packing");

static const char help[] =
    "usage: bench-graph [OPTION...]\n"
    "\n"
    "Measures rg_compile() on synthetic graphs of compute passes and of passes as real frames "
    "have\n"
    "them, beside a yardstick that only does the bare work, and how well it packs memory.\n"
    "\n"
    "  --only N         only the graphs of N passes, and no packing\n"
    "  --repetitions N  instead of fewer the longer the graph\n"
    "  --json FILE      also writes the results to FILE\n"
    "  --help           prints this text\n";

/* ---- options ---- */

static bool parse_count(const char *text, uint32_t max, uint32_t *count)
{
    char *end;
    errno = 0;
    unsigned long value = isdigit((unsigned char)*text) ? strtoul(text, &end, 10) : 0;
    if (!value || errno || *end || value > max)
        return false;
    *count = (uint32_t)value;
    return true;
}

static bool parse_option(struct options *options, const char *name, const char *value)
{
    if (!strcmp(name, "--only"))
        return parse_count(value, MAX_PASS_COUNT, &options->only);
    if (!strcmp(name, "--repetitions"))
        return parse_count(value, MAX_REPETITIONS, &options->repetitions);
    options->json = value;
    return !strcmp(name, "--json");
}

static bool parse(struct options *options, int count, char **arguments)
{
    for (int i = 1; i < count; i += 2) {
        if (!strcmp(arguments[i], "--help")) {
            options->help = true;
            return true;
        }
        if (i + 1 == count || !parse_option(options, arguments[i], arguments[i + 1])) {
            fprintf(stderr, "bench-graph: bad option %s; see --help\n", arguments[i]);
            return false;
        }
    }
    return true;
}

/* ---- measuring ---- */

/* As many repetitions as the first row has that is no shorter. */
static uint32_t repetitions_of(const struct options *options, uint32_t pass_count)
{
    uint32_t row = 0;
    while (row + 1 < GRAPH_COUNT && graph_rows[row].pass_count < pass_count)
        row++;
    return options->repetitions ? options->repetitions : graph_rows[row].repetitions;
}

static bool measure(struct report *report, const struct options *options)
{
    uint32_t graph_count = options->only ? 1 : GRAPH_COUNT;
    report_begin();
    for (uint32_t i = 0; i < graph_count * MEASURE_SHAPE_COUNT; i++) {
        enum measure_shape shape = (enum measure_shape)(i / graph_count);
        uint32_t row_count = graph_rows[i % graph_count].pass_count;
        uint32_t pass_count = options->only ? options->only : row_count;
        struct measure_graph *graph = &report->graphs[report->graph_count++];
        if (!measure_graph(graph, shape, pass_count, repetitions_of(options, pass_count)))
            return false;
        report_times(graph);
    }
    report_plans(report);
    if (options->only)
        return true;
    for (uint32_t i = 0; i < PACKING_COUNT; i++) {
        if (!measure_packing(&report->packings[report->packing_count++], packing_rows[i]))
            return false;
    }
    report_packings(report);
    return true;
}

int main(int argument_count, char **arguments)
{
    struct options options = { 0 };
    struct report report = { 0 };
    if (!parse(&options, argument_count, arguments))
        return EXIT_USAGE;
    if (options.help)
        return fputs(help, stdout) < 0;
    if (!measure(&report, &options) || (options.json && !report_json(&report, options.json)))
        return EXIT_FAILURE;
    return ferror(stdout) || fclose(stdout) ? EXIT_FAILURE : EXIT_SUCCESS;
}
