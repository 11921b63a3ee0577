/*
 * sweep.h: profiles of a frame as one or several parameters change: the points of the product of
 * their values, a table, JSON, and how cost grows.
 *
 * Ownership: a sweep owns all, points' profiles, too; {0} and half-built ones are fine.
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

struct profile_sweep {
    struct profile_parameter parameters[PROFILE_SWEEP_PARAMETERS];
    uint32_t parameter_count;
    struct profile *points; /* one for every combination; the last parameter changes fastest */
    uint32_t point_count;
};

/*
 * Adds a parameter, "name=a,b,c", and makes room for the points, all {0}. The name is that of a
 * setting, or "size", but neither is looked at here. STATUS_USAGE, logged: no name or value, a name
 * twice, too many parameters or points, text too long.
 */
MUST_USE enum status profile_sweep_add(struct profile_sweep *sweep, const char *text);
void profile_sweep_finish(struct profile_sweep *sweep);

/* What a parameter is set to at a point. */
const char *profile_sweep_value(const struct profile_sweep *sweep, uint32_t point,
                                uint32_t parameter);

/* The same as a number: of a size "WxH" its pixels. False if it is none. */
bool profile_sweep_number(const struct profile_sweep *sweep, uint32_t point, uint32_t parameter,
                          double *number);

/* How the median of something grows with the parameter. */
struct profile_growth {
    char name[PROFILE_NAME_SIZE]; /* "frame", or of rows, whose repetitions are added up */
    struct profile_fit fit;
};

/*
 * Of the frame and of everything that is more than 2 % of it at some point, from all points that
 * have it, when all have been measured. *growths is to be freed; it is NULL, and *count 0, where
 * there are several parameters, where a value is no number or where nothing can be fitted.
 */
MUST_USE enum status profile_sweep_fit(const struct profile_sweep *sweep,
                                       struct profile_growth **growths, uint32_t *count);

/* A line for every point: parameters, median and sigma of the frame, the passes that cost most; and
 * the fits. In PROFILE_COLUMNS columns. */
MUST_USE enum status profile_sweep_table(const struct profile_sweep *sweep, FILE *out);

/* docs/profile.md says what is in it. As profile_write_json(). */
MUST_USE enum status profile_write_sweep_json(const struct profile_sweep *sweep, char **text,
                                              size_t *size);

#endif
