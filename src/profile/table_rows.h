/*
 * table_rows.h: the lines of a profile's table, with repetitions added up and summaries.
 *
 * Ownership: lines own their samples and borrow the profile, which must outlive them.
 */
#ifndef FIRN_PROFILE_TABLE_ROWS_H
#define FIRN_PROFILE_TABLE_ROWS_H

#include "src/profile/profile.h"
#include "src/profile/statistics.h"

struct profile_table_row {
    const struct profile_row *row; /* the first row: name, kind, size of its targets */
    uint32_t row_count;            /* rows that are added up */
    double *ms;                    /* sum in each run */
    struct profile_summary summary;
    double share; /* of the frame, by the mean */
    /* Sums of the rows: */
    uint64_t target_bytes, vertices, triangles, fragments, invocations, covered;
};

struct profile_table_rows {
    struct profile_table_row *lines; /* in the order of the first row of each */
    uint32_t count;
    uint32_t pass_count; /* lines of passes; they are the first ones */
    struct profile_summary frame, plain;
};

/* Makes a line for every name or, if `each`, for every row. Logs and returns STATUS_TRY_AGAIN when
 * out of memory. */
MUST_USE enum status profile_table_rows_init(struct profile_table_rows *lines,
                                             const struct profile *profile, bool each);
void profile_table_rows_finish(struct profile_table_rows *lines);

/* Bytes of a line's name: "env_cube.objects x6", "env_cube.objects [2]". */
enum {
    PROFILE_TABLE_ROW_NAME_SIZE = PROFILE_NAME_SIZE + 24
};

/* Writes a line's name. */
void profile_table_row_name(const struct profile_table_row *line,
                            char name[static PROFILE_TABLE_ROW_NAME_SIZE]);

/* Returns the overhead of measuring: the median of `frame` over that of `plain`, minus 1; 0.02 is
 * 2 %. Returns 0 without `plain`. */
double profile_overhead(const struct profile *profile);

#endif
