/* diff_options.h: setters of the options of firn diff. */
#ifndef FIRN_APP_OPTIONS_DIFF_OPTIONS_H
#define FIRN_APP_OPTIONS_DIFF_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_exposure, option_curve, option_ppd, option_fail_above; /* of struct app_diff */
option_fn option_error_image; /* of struct setup_outputs */

#endif
