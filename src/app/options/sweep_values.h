/* sweep_values.h: parses --sweep and applies the values of each sweep point to the options. */
#ifndef FIRN_APP_OPTIONS_SWEEP_VALUES_H
#define FIRN_APP_OPTIONS_SWEEP_VALUES_H

#include "src/app/app.h"
#include "src/lab/profile/sweep.h"

/* Parses --sweep options and checks every point. Logs errors, and may leave *sweep incomplete. */
MUST_USE enum status sweep_values_parse(struct profile_sweep *sweep,
                                        const struct app_sweeps *sweeps,
                                        const struct setup_image *image);

/* Sets *at_point to the options of a sweep point. On failure logs and returns STATUS_USAGE. */
MUST_USE enum status sweep_values_apply(const struct profile_sweep *sweep, uint32_t point,
                                        const struct setup_image *image,
                                        struct setup_image *at_point);

#endif
