/* viewer.h: `firn view`: shows a scene in an interactive window. */
#ifndef FIRN_VIEW_VIEWER_H
#define FIRN_VIEW_VIEWER_H

#include "src/app/app.h"

/* Runs the viewer until its window is closed or the frames of --frames are drawn. Logs errors. */
enum status viewer_run(const struct app_options *options);

#endif
