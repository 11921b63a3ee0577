/*
 * row_aggregation.h: lines of a profile's table. A line adds up a pass's repetitions and summarises
 * all runs. Lines own their samples and borrow the profile, which must outlive them.
 */
#ifndef FIRN_LAB_PROFILE_ROW_AGGREGATION_H
#define FIRN_LAB_PROFILE_ROW_AGGREGATION_H

#include "src/lab/profile/profile_data.h"
#include "src/lab/profile/statistics.h"

struct profile_table_row {
    const struct profile_row *row; /* first aggregated row */
    uint32_t row_count;            /* number of aggregated rows */
    double *ms;                    /* sum over rows, per run */
    struct profile_summary summary;
    double fraction; /* fraction of the mean frame time */
    /* Sums over the aggregated rows. */
    uint64_t target_bytes, vertices, triangles, fragments, invocations, covered;
};

struct profile_table_rows {
    struct profile_table_row *lines; /* in order of first occurrence */
    uint32_t count;
    uint32_t pass_count; /* pass lines, which precede others */
    struct profile_summary frame, plain;
};

/* Creates one table line per pass name or, if `each` is true, per row. Logs when out of memory. */
MUST_USE enum status profile_table_rows_init(struct profile_table_rows *lines,
                                             const struct profile *profile, bool each);
void profile_table_rows_finish(struct profile_table_rows *lines);

/* Maximum size of a line's name, such as "env_cube.objects x6" or "env_cube.objects [2]". */
enum {
    PROFILE_TABLE_ROW_NAME_SIZE = PROFILE_NAME_SIZE + 24
};

/* Writes the display name of a line. */
void profile_table_row_name(const struct profile_table_row *line,
                            char name[static PROFILE_TABLE_ROW_NAME_SIZE]);

/* Returns by what fraction measuring increases the median frame time, or 0 without `plain`. */
double profile_overhead(const struct profile *profile);

#endif
