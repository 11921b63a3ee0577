/*
 * view_progressive.h: progressive refinement: low-latency frames during interaction, more samples
 * at rest.
 *
 * The view is identified by value (camera, time, settings, renderers), so samples accumulate until
 * one of these really changes.
 */
#ifndef FIRN_VIEW_VIEW_PROGRESSIVE_H
#define FIRN_VIEW_VIEW_PROGRESSIVE_H

#include "src/scene/camera.h"
#include "src/settings/settings.h"
#include "src/view/dynamic_resolution.h"
#include "src/view/noise_estimate.h"

enum {
    VIEW_SAMPLE_COUNT = 64, /* default of --samples */
};

/* Everything the image depends on, except for the exposure. */
struct view_identity {
    uint64_t version; /* of the viewport's renderers */
    struct camera camera;
    float time;
    struct settings settings;
};

struct view_progressive {
    struct view_identity
        seen; /* view of the accumulated samples or of the last interactive frame */
    bool has_seen;
    uint32_t count, goal;        /* samples drawn; samples to draw */
    uint32_t shown;              /* samples of the displayed image; 0 during interaction */
    struct noise_estimate noise; /* noise estimate of the left image */
    bool is_whole;               /* a full-size draft was drawn for this view */
    double begun_at;             /* start of sample 0, seconds */
    double sample;               /* duration of the last sample, seconds; 0 if none */
    double moved_at;             /* last interactive frame or button press, seconds */
    double shown_at;             /* last displayed mean, seconds */
    bool at_once;                /* the mouse was released: start sampling without delay */
    struct dynamic_resolution moving;
};

#endif
