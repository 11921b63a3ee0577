/* farm_options.h: setters of the options of firn farm. */
#ifndef FIRN_APP_OPTIONS_FARM_OPTIONS_H
#define FIRN_APP_OPTIONS_FARM_OPTIONS_H

#include "src/app/options/option.h"

option_fn option_farm_sbatch, option_farm_hosts; /* of struct app_farm */

#endif
