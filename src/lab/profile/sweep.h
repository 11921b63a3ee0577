/*
 * sweep.h: parameter sweeps: a profile for each combination of parameter values. A sweep owns its
 * parameters and profiles; profile_sweep_finish() accepts incomplete and zeroed sweeps.
 */
#ifndef FIRN_LAB_PROFILE_SWEEP_H
#define FIRN_LAB_PROFILE_SWEEP_H

#include "src/lab/profile/profile_data.h"

enum {
    PROFILE_SWEEP_PARAMETERS = 4,
    PROFILE_SWEEP_POINTS = 1000
};

struct profile_parameter {
    char *name; /* followed in memory by the values, each with a terminating 0 */
    uint32_t value_count;
};

struct profile_sweep {
    struct profile_parameter parameters[PROFILE_SWEEP_PARAMETERS];
    uint32_t parameter_count;
    uint32_t point_count;   /* combinations of values; the last parameter varies fastest */
    struct profile *points; /* NULL, or one per combination */
    bool slowest_first;     /* order of the passes in the table of a single point */
};

/*
 * Adds a parameter given as "name=a,b,c" to a sweep with fewer than PROFILE_SWEEP_PARAMETERS. The
 * name is a setting or option. Does not validate names and values. Logs an error and returns
 * STATUS_USAGE if a part is missing, a name occurs twice, or there are too many points.
 */
MUST_USE enum status profile_sweep_add(struct profile_sweep *sweep, const char *text);
void profile_sweep_finish(struct profile_sweep *sweep);

/* Returns the value of a parameter at a point. */
const char *profile_sweep_value(const struct profile_sweep *sweep, uint32_t point,
                                uint32_t parameter);

#endif
