/* diff_report.h: what firn diff prints. docs/diff.md says what each number and key means. */
#ifndef FIRN_APP_DIFF_REPORT_H
#define FIRN_APP_DIFF_REPORT_H

#include <stdio.h>
#include "src/app/app.h"
#include "src/metric/comparison.h"

struct diff_report {
    const struct app_options *options;
    const struct comparison *comparison;
    uint32_t width, height; /* pixels */
    double ppd;
    bool failed[COMPARISON_METRIC_COUNT]; /* above the limits of the options */
};

/* Lines of at most 100 columns, unless names are long. */
void diff_report_text(const struct diff_report *report, FILE *out);

/* One object. False: memory is short. */
bool diff_report_json(const struct diff_report *report, FILE *out);

#endif
