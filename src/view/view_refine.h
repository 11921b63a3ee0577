/*
 * view_refine.h: a picture that is fluid while something moves, and gets better when it is still.
 *
 * What is seen is known by value (camera, time, settings, renderers): whatever else happens, the
 * samples go on.
 */
#ifndef FIRN_VIEW_VIEW_REFINE_H
#define FIRN_VIEW_VIEW_REFINE_H

#include "src/scene/camera.h"
#include "src/settings/settings.h"
#include "src/view/moving.h"
#include "src/view/noise.h"

enum {
    VIEW_SAMPLE_COUNT = 64, /* unless --samples says so */
};

/* What a picture depends on, but for its exposure. */
struct view_seen {
    uint64_t version; /* of the picture */
    struct camera camera;
    float time;
    struct settings settings;
};

struct view_refine {
    struct view_seen seen; /* by the samples, or by the last picture of a movement */
    bool has_seen;
    uint32_t count, goal; /* samples drawn; at rest: all */
    uint32_t shown;       /* samples of the picture that is shown; 0: of a movement */
    struct noise noise;   /* of the left picture */
    bool is_whole;        /* a movement's last picture has been drawn in full size */
    double begun_at;      /* seconds; sample 0 */
    double sample;        /* seconds that one takes; 0: none has been drawn */
    double moved_at;      /* seconds; of the last picture of a movement, or a hand on the mouse */
    double shown_at;      /* seconds; of the last mean */
    bool at_once;         /* a hand has let go: nothing to wait for */
    struct moving moving;
};

#endif
