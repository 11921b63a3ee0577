/* profile_options.h: setters of the options of firn profile. */
#ifndef FIRN_APP_OPTIONS_PROFILE_OPTIONS_H
#define FIRN_APP_OPTIONS_PROFILE_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_time_step; /* of a double */
option_fn option_clock;     /* of enum rg_clock */
option_fn option_sweep;     /* of struct app_sweeps */

#endif
