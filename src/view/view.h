/*
 * view.h: firn view: a scene in a window.
 */
#ifndef FIRN_VIEW_VIEW_H
#define FIRN_VIEW_VIEW_H

#include "src/app/app.h"

/* Until the user closes the window or as many frames are drawn as the options name. Logs. */
enum status view_run(const struct app_options *options);

#endif
