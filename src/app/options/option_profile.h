/* option_profile.h: setters of the options of firn profile. */
#ifndef FIRN_APP_OPTIONS_OPTION_PROFILE_H
#define FIRN_APP_OPTIONS_OPTION_PROFILE_H

#include "src/app/options/option.h"

option_fn option_time_step; /* of a double */
option_fn option_clock;     /* of enum rg_clock */
option_fn option_sweep;     /* of struct app_sweeps */

#endif
