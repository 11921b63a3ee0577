/* option_view.h: what the options of firn view set. */
#ifndef FIRN_APP_OPTIONS_OPTION_VIEW_H
#define FIRN_APP_OPTIONS_OPTION_VIEW_H

#include "src/app/options/option.h"

option_fn option_present, option_overlay, option_theme, option_ui_scale; /* of struct app_view */
option_fn option_watch;                                                  /* the same */
option_fn option_split;                                                  /* of struct app_picture */

#endif
