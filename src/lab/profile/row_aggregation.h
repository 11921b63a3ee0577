/*
 * row_aggregation.h: lines of a profile's table. A line adds up a pass's repetitions and summarises
 * all runs. Lines own their samples and borrow the profile, which must outlive them.
 */
#ifndef FIRN_LAB_PROFILE_ROW_AGGREGATION_H
#define FIRN_LAB_PROFILE_ROW_AGGREGATION_H

#include "src/lab/profile/profile_data.h"
#include "src/lab/profile/statistics.h"

struct profile_line {
    const char *name;
    const struct profile_row *row; /* first aggregated row; NULL for the frame */
    uint32_t row_count;            /* number of aggregated rows */
    double *ms;                    /* sums over the rows, one per run, in ascending order */
    struct profile_summary summary;
    /* Sums over the aggregated rows. */
    uint64_t target_bytes, vertices, triangles, fragments, invocations, covered;
};

struct profile_lines {
    struct profile_line *lines; /* in order of first occurrence; the last line is the frame */
    uint32_t count;
};

/* Creates one line per pass name, and the frame's line. Logs when out of memory. */
MUST_USE enum status profile_lines_init(struct profile_lines *lines, const struct profile *profile);
void profile_lines_finish(struct profile_lines *lines);

/* Returns the line of this name, or NULL. */
struct profile_line *profile_line_find(const struct profile_lines *lines, const char *name);

/* Returns by what fraction measuring increases the median frame time, or 0 without `plain`. */
double profile_overhead(const struct profile *profile);

#endif
