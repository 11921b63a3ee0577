/*
 * sweep_power_law.h: parameter sweeps with power-law fits of the costs. A sweep measures a profile
 * for each combination of parameter values. It owns its parameters and profiles, but borrows its
 * contrasts and figures. profile_sweep_finish() accepts incomplete and zeroed sweeps.
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
 * Adds a parameter given as "name=a,b,c", and reallocates and zeroes all points. The name is a
 * setting or "size". Does not validate names and values. Logs an error and returns STATUS_USAGE if
 * a part is missing, a name occurs twice, a text is too long, or parameters or points are too many.
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
 * Fits power laws to the frame time and to each row above 2 % of the frame time at some point. All
 * points must have been measured. The caller frees *growths. If there are several parameters,
 * values that are not numbers, or no valid fits, *growths is NULL and *count is 0.
 */
MUST_USE enum status profile_sweep_fit(const struct profile_sweep *sweep,
                                       struct profile_growth **growths, uint32_t *count);

/* Prints one line per point, then the power-law fits. A line has the parameters, the frame time's
 * median and standard deviation, and the most expensive passes. Lines have at most PROFILE_COLUMNS
 * characters. */
MUST_USE enum status profile_sweep_table(const struct profile_sweep *sweep, FILE *out);

/* Writes the sweep as JSON (docs/profile.md). The caller frees *text as in profile_write_json(). */
MUST_USE enum status profile_write_sweep_json(const struct profile_sweep *sweep, char **text,
                                              size_t *size);

#endif
