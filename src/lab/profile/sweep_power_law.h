/*
 * sweep_power_law.h: parameter sweeps, which measure a profile for each combination of parameter
 * values, and fit power laws to the costs. A sweep owns its parameters and profiles, but borrows
 * its contrasts and figures. profile_sweep_finish() accepts incomplete and zeroed sweeps.
 */
#ifndef FIRN_LAB_PROFILE_SWEEP_POWER_LAW_H
#define FIRN_LAB_PROFILE_SWEEP_POWER_LAW_H

#include <stdbool.h>
#include <stdio.h>
#include "src/lab/profile/profile_data.h"
#include "src/lab/profile/statistics.h"

enum {
    PROFILE_SWEEP_PARAMETERS = 4,
    PROFILE_SWEEP_POINTS = 1000
};

struct profile_parameter {
    char name[PROFILE_NAME_SIZE];
    char (*values)[PROFILE_NAME_SIZE];
    uint32_t value_count;
};

/* Comparison of two points of a sweep, to check a published claim. */
struct profile_contrast {
    const char *where, *what, *claim; /* "figure 6", difference, published claim */
    uint32_t before, after;           /* indices of the points */
    struct profile_ratio rate;        /* frame rate after / before */
    double p;                         /* Mann-Whitney p-value, Holm-adjusted over all contrasts */
};

struct profile_sweep {
    struct profile_parameter parameters[PROFILE_SWEEP_PARAMETERS];
    uint32_t parameter_count;
    struct profile *points; /* the last parameter varies fastest */
    uint32_t point_count;
    struct profile_contrast *contrasts; /* borrowed */
    uint32_t contrast_count;
};

/* Computes `rate` and `p` of all contrasts from the frames without measurement (profile.plain).
 * When out of memory logs and returns STATUS_TRY_AGAIN. */
MUST_USE enum status profile_contrast_all(struct profile_sweep *sweep);

/*
 * Adds a parameter given as "name=a,b,c". Reallocates and zeroes all points. The name is a setting
 * or "size". Names and values are not validated. Logs and returns STATUS_USAGE if a name or value
 * is missing, a name occurs twice, a text is too long, or there are too many parameters or points.
 */
MUST_USE enum status profile_sweep_add(struct profile_sweep *sweep, const char *text);
void profile_sweep_finish(struct profile_sweep *sweep);

/* Returns the value of a parameter at a point. */
const char *profile_sweep_value(const struct profile_sweep *sweep, uint32_t point,
                                uint32_t parameter);

/* Converts a parameter's value at a point to a number. A size "WxH" becomes the number of pixels.
 * Returns false if the value is not a number. */
bool profile_sweep_number(const struct profile_sweep *sweep, uint32_t point, uint32_t parameter,
                          double *number);

/* Growth of a row's median time with the swept parameter. */
struct profile_growth {
    char name[PROFILE_NAME_SIZE]; /* "frame" or a row, repetitions added */
    struct profile_fit fit;
};

/*
 * Fits power laws to the frame time and to all rows that exceed 2 % of the frame time at some
 * point. All points must have been measured. The caller frees *growths. *growths is NULL and *count
 * is 0 if there are several parameters, values that are not numbers, or no valid fits.
 */
MUST_USE enum status profile_sweep_fit(const struct profile_sweep *sweep,
                                       struct profile_growth **growths, uint32_t *count);

/* Prints one line per point: parameters, median and standard deviation of the frame time, and the
 * most expensive passes. Then prints the power-law fits. Lines have at most PROFILE_COLUMNS
 * characters. */
MUST_USE enum status profile_sweep_table(const struct profile_sweep *sweep, FILE *out);

/* Writes the sweep as JSON (docs/profile.md). The caller frees *text as in profile_write_json(). */
MUST_USE enum status profile_write_sweep_json(const struct profile_sweep *sweep, char **text,
                                              size_t *size);

#endif
