/* option_farm.h: setters of the options of firn farm. */
#ifndef FIRN_APP_OPTIONS_OPTION_FARM_H
#define FIRN_APP_OPTIONS_OPTION_FARM_H

#include "src/app/options/option.h"

option_fn option_farm_sbatch, option_farm_hosts; /* of struct app_farm */

#endif
