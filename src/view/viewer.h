/* viewer.h: `firn view`: shows a scene in an interactive window. */
#ifndef FIRN_VIEW_VIEWER_H
#define FIRN_VIEW_VIEWER_H

#include "src/setup/setup.h"

/* Parameters of the viewer, which must outlive viewer_run(). */
struct viewer_params {
    const struct setup_image *image;
    const struct setup_window *window;
    const struct setup_outputs *outputs; /* files of --screenshot */
    struct gpu_params gpu;
    bool quiet; /* print no notes */
};

/* Runs the viewer until its window is closed or the frames of --frames are drawn. Logs errors. */
enum status viewer_run(const struct viewer_params *options);

#endif
