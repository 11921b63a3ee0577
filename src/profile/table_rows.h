/*
 * table_rows.h: a profile as rows of a table: repetitions are added up, with summaries.
 *
 * Ownership: lines own their samples and borrow the profile's names.
 */
#ifndef FIRN_PROFILE_TABLE_ROWS_H
#define FIRN_PROFILE_TABLE_ROWS_H

#include "src/profile/profile.h"
#include "src/profile/statistics.h"

struct profile_table_row {
    const struct profile_row *row; /* the first of them: name, kind, size of its targets */
    uint32_t row_count;            /* that are added up */
    double *ms;                    /* one a run */
    struct profile_summary summary;
    double share; /* of the frame, by the mean */
    /* sums: */
    uint64_t target_bytes, vertices, triangles, fragments, invocations, covered;
};

struct profile_table_rows {
    struct profile_table_row *lines; /* in the order of the first row of each */
    uint32_t count;
    uint32_t pass_count; /* of them */
    struct profile_summary frame, plain;
};

/* A line for every name, or, if `each`, for every row. */
MUST_USE enum status profile_table_rows_init(struct profile_table_rows *lines,
                                             const struct profile *profile, bool each);
void profile_table_rows_finish(struct profile_table_rows *lines);

/* Room for a line's name in PROFILE_COLUMNS: "env_cube.objects x6", "env_cube.objects [2]" */
enum {
    PROFILE_TABLE_ROW_NAME_SIZE = PROFILE_NAME_SIZE + 24
};

void profile_table_row_name(const struct profile_table_row *line,
                            char name[static PROFILE_TABLE_ROW_NAME_SIZE]);

/* What measuring costs: how much more the median of `frame` is than that of `plain`; 0.02 is 2 %.
 * 0 where there is none of `plain`. */
double profile_overhead(const struct profile *profile);

#endif
