/*
 * lines.h: a profile as the lines of a table: rows whose repetitions are added up, with summaries.
 *
 * Ownership: lines own their samples and borrow the profile's names.
 */
#ifndef FIRN_PROFILE_LINES_H
#define FIRN_PROFILE_LINES_H

#include "src/profile/profile.h"
#include "src/profile/statistics.h"

struct profile_line {
    const struct profile_row *row; /* the first of them: name, kind, size of its targets */
    uint32_t row_count;            /* that are added up */
    double *ms;                    /* one a run */
    struct profile_summary summary;
    double share; /* of the frame, by the mean */
    /* sums: */
    uint64_t target_bytes, vertices, triangles, fragments, invocations, covered;
};

struct profile_lines {
    struct profile_line *lines; /* in the order of the first row of each */
    uint32_t count;
    uint32_t pass_count; /* of them */
    struct profile_summary frame, plain;
};

/* A line for every name, or, if `each`, for every row. */
MUST_USE enum status profile_lines_init(struct profile_lines *lines, const struct profile *profile,
                                        bool each);
void profile_lines_finish(struct profile_lines *lines);

/* Room for a line's name in PROFILE_COLUMNS: "env_cube.objects x6", "env_cube.objects [2]" */
enum {
    PROFILE_LINE_NAME_SIZE = PROFILE_NAME_SIZE + 24
};

void profile_line_name(const struct profile_line *line, char name[static PROFILE_LINE_NAME_SIZE]);

/* What measuring costs: how much more the median of `frame` is than that of `plain`; 0.02 is 2 %.
 * 0 where there is none of `plain`. */
double profile_overhead(const struct profile *profile);

#endif
