/* diff_report.h: prints the result of firn diff. See docs/how-to/diff.md. */
#ifndef FIRN_APP_DIFF_REPORT_H
#define FIRN_APP_DIFF_REPORT_H

#include <stdio.h>
#include "src/app/app.h"
#include "src/lab/metric/layer_comparison.h"

struct diff_report {
    const struct app_options *options;
    const struct comparison *comparison;
    uint32_t width, height; /* pixels */
    double ppd;
    bool failed[COMPARISON_METRIC_COUNT]; /* the metric exceeds its --fail-above limit */
};

/* Prints the report as text. Lines have at most 100 columns unless they contain long names. */
void diff_report_text(const struct diff_report *report, FILE *out);

/* Prints the report as one JSON object. Returns false when out of memory. */
bool diff_report_json(const struct diff_report *report, FILE *out);

#endif
