/* ui_frame_bottleneck.h: frame pacing: how long frames take and what limits the frame rate. */
#ifndef FIRN_VIEW_PANELS_UI_FRAME_BOTTLENECK_H
#define FIRN_VIEW_PANELS_UI_FRAME_BOTTLENECK_H

/* Times of one frame, or running means, in seconds. The intervals may overlap. */
struct ui_frame_pacing {
    double frame;  /* between the starts of two frames */
    double device; /* device time, or waiting for it; negative if it was not measured */
    double screen; /* acquiring or presenting an image */
};

/* Adds a sample to the running means. Ignores samples with frame time 0. */
void ui_frame_pacing_add(struct ui_frame_pacing *pace, const struct ui_frame_pacing *sample);

/* Returns what limits the frame rate, as a phrase for the status bar; NULL if it is not known. */
const char *ui_frame_pacing_limit(const struct ui_frame_pacing *pace);

#endif
