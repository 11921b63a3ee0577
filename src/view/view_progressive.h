/* view_progressive.h: progressive refinement: fast frames during interaction, samples at rest.
 * Samples accumulate until camera, time, settings or renderers change. Current and previous values
 * are compared to find changes. */
#ifndef FIRN_VIEW_VIEW_PROGRESSIVE_H
#define FIRN_VIEW_VIEW_PROGRESSIVE_H

#include "src/scene/camera.h"
#include "src/settings/settings.h"
#include "src/view/dynamic_resolution.h"

enum {
    VIEW_SAMPLE_COUNT = 64, /* default of --samples */
};

/* Everything the image depends on, except for the exposure. */
struct view_identity {
    uint64_t renderer_version; /* of the viewport's renderers */
    struct camera camera;
    float time;
    struct settings settings;
};

struct view_progressive {
    struct view_identity identity; /* view that was drawn last */
    bool has_identity;
    uint32_t count, target_count; /* samples drawn; samples to draw */
    uint32_t shown_count;         /* displayed samples; 0 during interaction */
    bool has_full_draft;          /* a full-size draft was drawn */
    double begun_at;              /* start of sample 0, seconds */
    double sample_begun_at;       /* start of the sample that is drawn, seconds */
    double sample_seconds;        /* last duration, seconds; 0 if none */
    bool is_stopped;              /* by the user, until the view changes */
    bool is_partial;              /* a sample is drawn or added in part */
    bool is_resolving;            /* the mean of the samples is about to be shown */
    uint32_t resolve_step;        /* next step of that */
    bool drew_part;               /* a part was drawn since input was last polled */
    double moved_at;              /* last interaction, seconds */
    double shown_at;              /* last displayed mean, seconds */
    bool skips_rest;              /* sample without delay after mouse release */
    struct dynamic_resolution dynamic_resolution;
};

#endif
