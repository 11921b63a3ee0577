/* option_farm.h: what the options of firn farm set; values are as on the command line. */
#ifndef FIRN_APP_OPTIONS_OPTION_FARM_H
#define FIRN_APP_OPTIONS_OPTION_FARM_H

#include "src/app/options/option.h"

option_fn option_farm_tasks, option_farm_submit, option_farm_sbatch, option_farm_hosts;

#endif
