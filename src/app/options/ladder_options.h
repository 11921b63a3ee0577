/* ladder_options.h: setters and default settings of firn ladder. */
#ifndef FIRN_APP_OPTIONS_LADDER_OPTIONS_H
#define FIRN_APP_OPTIONS_LADDER_OPTIONS_H

#include "src/app/app.h"
#include "src/app/options/option.h"

option_fn option_ladder_output;     /* of struct setup_outputs */
option_fn option_refraction_models; /* of struct app_ladder */

/* Sets the defaults of firn ladder: exact refraction, without effects that the path tracer does not
 * draw. Must be called before the options are parsed. */
void option_ladder_settings(struct settings *settings);

/* Switches the inclusions and surface effects of ice back on. Keeps the settings that --set and
 * --preset have made. Cracks are drawn as gaps, because the path tracer draws them as gaps. */
void option_ladder_whole(struct setup_scene *scene);

#endif
