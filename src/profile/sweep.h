/*
 * sweep.h: profiles of a frame for all combinations of several parameters' values, as a table or
 * JSON, with fits of the costs' growth.
 *
 * Ownership: a sweep owns all its data, including the profiles; {0} and half-built ones are fine.
 */
#ifndef FIRN_PROFILE_SWEEP_H
#define FIRN_PROFILE_SWEEP_H

#include <stdbool.h>
#include <stdio.h>
#include "src/profile/profile.h"
#include "src/profile/statistics.h"

enum {
    PROFILE_SWEEP_PARAMETERS = 4,
    PROFILE_SWEEP_POINTS = 1000
};

struct profile_parameter {
    char name[PROFILE_NAME_SIZE];
    char (*values)[PROFILE_NAME_SIZE];
    uint32_t value_count;
};

/* Two points of a sweep, and what somebody has said of them. */
struct profile_contrast {
    const char *where, *what, *said; /* "figure 6", what differs, "about -26 %" */
    uint32_t before, after;          /* points */
    struct profile_ratio rate;       /* frame rate after / before: profile_contrast_all() */
    double p;                        /* Mann-Whitney, after Holm's correction for all contrasts */
};

enum {
    PROFILE_FIGURE_SERIES = 2,
    PROFILE_FIGURE_COLUMNS = 3
};

/* A chart of frame rates: a curve or bars for each series, over columns. */
struct profile_figure {
    const char *title, *axis; /* "Figure 6: ...", what the columns are */
    bool is_bars;
    const char *columns[PROFILE_FIGURE_COLUMNS];
    const char *series[PROFILE_FIGURE_SERIES]; /* the second may be NULL */
    uint32_t points[PROFILE_FIGURE_SERIES][PROFILE_FIGURE_COLUMNS];
    uint32_t column_count;
};

struct profile_sweep {
    struct profile_parameter parameters[PROFILE_SWEEP_PARAMETERS];
    uint32_t parameter_count;
    struct profile *points; /* one for each combination; the last parameter changes fastest */
    uint32_t point_count;
    struct profile_contrast *contrasts; /* borrowed, as is: */
    uint32_t contrast_count;
    const struct profile_figure *figures;
    uint32_t figure_count;
};

/* Computes `rate` and `p` of all contrasts, of frames that were not measured pass by pass. Logs and
 * returns STATUS_TRY_AGAIN when out of memory. */
MUST_USE enum status profile_contrast_all(struct profile_sweep *sweep);

/*
 * Adds a parameter, "name=a,b,c", and allocates the points, all {0}. The name is that of a setting,
 * or "size"; name and values are not checked here. Logs and returns STATUS_USAGE if there is no
 * name or value, a name occurs twice, there are too many parameters or points, or a text is too
 * long.
 */
MUST_USE enum status profile_sweep_add(struct profile_sweep *sweep, const char *text);
void profile_sweep_finish(struct profile_sweep *sweep);

/* Returns the value of a parameter at a point. */
const char *profile_sweep_value(const struct profile_sweep *sweep, uint32_t point,
                                uint32_t parameter);

/* Converts the value of a parameter at a point to a number; a size "WxH" is its pixels. Returns
 * false if it is no number. */
bool profile_sweep_number(const struct profile_sweep *sweep, uint32_t point, uint32_t parameter,
                          double *number);

/* The growth of a median with the parameter. */
struct profile_growth {
    char name[PROFILE_NAME_SIZE]; /* "frame", or the name of rows, with repetitions added up */
    struct profile_fit fit;
};

/*
 * Fits the frame and all rows that are more than 2 % of it at some point, over all points that have
 * the row. All points must be measured. The caller frees *growths; it is NULL, and *count 0, if
 * there are several parameters, a value is no number or nothing can be fitted.
 */
MUST_USE enum status profile_sweep_fit(const struct profile_sweep *sweep,
                                       struct profile_growth **growths, uint32_t *count);

/* Writes a line for every point, with parameters, median and sigma of the frame and the costliest
 * passes, and the fits, in PROFILE_COLUMNS columns. */
MUST_USE enum status profile_sweep_table(const struct profile_sweep *sweep, FILE *out);

/* Writes JSON as docs/profile.md describes it. Ownership and errors are those of
 * profile_write_json(). */
MUST_USE enum status profile_write_sweep_json(const struct profile_sweep *sweep, char **text,
                                              size_t *size);

#endif
