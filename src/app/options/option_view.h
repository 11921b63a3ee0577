/* option_view.h: what the options of firn view set. */
#ifndef FIRN_APP_OPTIONS_OPTION_VIEW_H
#define FIRN_APP_OPTIONS_OPTION_VIEW_H

#include "src/app/options/option.h"

option_fn option_frame_count, option_fps_limit, option_present, option_overlay, option_split,
    option_watch;

#endif
