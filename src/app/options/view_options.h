/* view_options.h: setters of the options of firn view. */
#ifndef FIRN_APP_OPTIONS_VIEW_OPTIONS_H
#define FIRN_APP_OPTIONS_VIEW_OPTIONS_H

#include "src/app/options/option.h"

/* of struct setup_window */
option_fn option_present, option_overlay, option_theme, option_ui_scale, option_watch;
option_fn option_split; /* of struct setup_image */

#endif
