/* option_profile.h: what the options of firn profile set. */
#ifndef FIRN_APP_OPTIONS_OPTION_PROFILE_H
#define FIRN_APP_OPTIONS_OPTION_PROFILE_H

#include "src/app/options/option.h"

option_fn option_runs, option_warmup, option_time_step, option_clock, option_sweep;
option_fn option_baseline, option_each, option_json, option_csv, option_trace, option_html;
option_fn option_capture;

#endif
