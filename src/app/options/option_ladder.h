/* option_ladder.h: what the options of firn ladder set. */
#ifndef FIRN_APP_OPTIONS_OPTION_LADDER_H
#define FIRN_APP_OPTIONS_OPTION_LADDER_H

#include "src/app/app.h"
#include "src/app/options/option.h"

option_fn option_ladder_output; /* of struct app_outputs */
option_fn option_rungs;         /* of struct app_ladder */

/* Settings that the reference leaves out are off, and rungs are exact where they can be, unless the
 * command line says otherwise. */
void option_ladder_settings(struct settings *settings);

/* Switches on again what only ice has, as in other commands, but for what the words set; cracks are
 * gaps, as in the reference. */
void option_ladder_whole(struct app_scene *scene);

#endif
