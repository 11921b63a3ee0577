/* sweep_options.h: --sweep, from its words to the options of each of its points. */
#ifndef FIRN_APP_OPTIONS_SWEEP_OPTIONS_H
#define FIRN_APP_OPTIONS_SWEEP_OPTIONS_H

#include "src/app/app.h"
#include "src/profile/sweep.h"

/* All of them, and whether every point's words are right. Logs; *sweep may then be half-built. */
MUST_USE enum status sweep_options_parse(struct profile_sweep *sweep,
                                         const struct app_sweeps *sweeps,
                                         const struct app_picture *picture);

/* The picture of a point. Logs: STATUS_USAGE. */
MUST_USE enum status sweep_options_at(const struct profile_sweep *sweep, uint32_t point,
                                      const struct app_picture *picture,
                                      struct app_picture *at_point);

#endif
