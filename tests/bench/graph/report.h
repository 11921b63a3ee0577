/*
 * report.h: measurements as tables on stdout, and as JSON.
 */
#ifndef TESTS_REPORT_H
#define TESTS_REPORT_H

#include "tests/bench/graph/measure.h"

enum {
    REPORT_MAX_GRAPHS = 12,
    REPORT_MAX_PACKINGS = 4,
};

struct report {
    struct measure_graph graphs[REPORT_MAX_GRAPHS];
    uint32_t graph_count;
    struct measure_packing packings[REPORT_MAX_PACKINGS];
    uint32_t packing_count;
};

void report_begin(void); /* how it was compiled, and the head of the times */
void report_times(const struct measure_graph *graph);
void report_plans(const struct report *report); /* with their heads */
void report_packings(const struct report *report);

/* False, with a line on stderr, if the file could not be written. */
bool report_json(const struct report *report, const char *path);

#endif
