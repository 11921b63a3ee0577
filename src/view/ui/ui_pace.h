/*
 * ui_pace.h: how fast frames follow each other, and what keeps them from being faster.
 */
#ifndef FIRN_VIEW_UI_UI_PACE_H
#define FIRN_VIEW_UI_UI_PACE_H

/* Of a frame, or smoothed over some: seconds. All but the first happen side by side. */
struct ui_pace {
    double frame;  /* from one to the next */
    double device; /* the device worked, or the host waited for it */
    double screen; /* the host waited for an image to draw to, and for it to be shown */
    double limit;  /* the host waited because of --fps-limit */
};

/* *pace comes nearer to the sample, from {0} at once; a sample without a frame counts nothing. */
void ui_pace_add(struct ui_pace *pace, const struct ui_pace *sample);

/* What frames wait for, in words. */
const char *ui_pace_limit(const struct ui_pace *pace);

#endif
