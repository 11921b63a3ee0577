/*
 * profile_reports.h: tables and files of profiles. docs/how-to/profile.md describes the formats.
 *
 * Reports are of a sweep; a single profile is a sweep of one point without parameters. All
 * functions log an error and return STATUS_TRY_AGAIN if out of memory. The caller checks `out` for
 * errors.
 */
#ifndef FIRN_LAB_PROFILE_PROFILE_REPORTS_H
#define FIRN_LAB_PROFILE_PROFILE_REPORTS_H

#include <stdbool.h>
#include <stdio.h>
#include "src/lab/profile/sweep.h"

typedef enum status profile_report_fn(const struct profile_sweep *sweep, FILE *out);

/* Prints a table of the times and counts of all passes or, of several points, the median times by
 * pass and point. */
profile_report_fn profile_table;

/* Writes all samples or, of several points, the median times by point and pass, as comma-separated
 * values of RFC 4180. */
profile_report_fn profile_csv;

/* Writes JSON with all samples. Numbers have full precision. */
profile_report_fn profile_json;

/* Writes a profile as a Chrome trace for Perfetto, Tracy (tracy-import-chrome) etc.: the object
 * form of Google's "Trace Event Format". Runs are consecutive; a run's GPU passes start when the
 * CPU has submitted them. */
profile_report_fn profile_trace;

/*
 * Reads a profile that profile_json() has written. The file is untrusted. If keys are missing or
 * data are invalid, logs an error and returns STATUS_DATA. Replaces control characters in strings,
 * which are a risk in terminals, by '?'. On failure *profile is zeroed.
 */
MUST_USE enum status profile_read_json(const char *path, struct profile *profile);

/*
 * Compares a profile with a baseline. Prints a table: medians, their ratio, and a verdict by the
 * Mann-Whitney test at 1 %, with Bonferroni correction for the number of tests. Passes are matched
 * by name; repetitions are added up. Also lists different conditions: device, size, clock, settings
 * ... Sets *is_slower if the median of a row is significantly larger, by at least `threshold`, a
 * fraction of the baseline. If there are too few runs for any difference to be significant, logs an
 * error after the table and returns STATUS_USAGE.
 */
MUST_USE enum status profile_compare(const struct profile *base, const struct profile *now,
                                     double threshold, FILE *out, bool *is_slower);

#endif
