/* option_quality.h: what --quality sets. */
#ifndef FIRN_APP_OPTIONS_OPTION_QUALITY_H
#define FIRN_APP_OPTIONS_OPTION_QUALITY_H

#include "src/app/options/option.h"

/* Of struct app_picture: --set and --preset win. */
option_fn option_quality;

/* Makes the level that of firn render, unless a level, samples, a preset or a limit was named. */
void option_quality_of_files(struct app_options *o);

#endif
