/* option_ladder.h: what the options of firn ladder set. */
#ifndef FIRN_APP_OPTIONS_OPTION_LADDER_H
#define FIRN_APP_OPTIONS_OPTION_LADDER_H

#include "src/app/options/option.h"

option_fn option_ladder_output, option_rungs, option_costs, option_furnace, option_truth;

/* Settings that the reference leaves out are off, and rungs are exact where they can be, unless the
 * command line says otherwise. */
void option_ladder_defaults(struct app_options *o);

#endif
