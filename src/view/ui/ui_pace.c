/* ui_pace.c: running means, and which of them is all of a frame. */
#include "src/view/ui/ui_pace.h"

static const double share = 0.1; /* of the newest frame in the mean */
static const double busy = 0.8;  /* of a frame: nothing else counts */
static const double waits = 0.3; /* of a frame: more than chance */

static void mix(double *mean, double value, double by)
{
    *mean += by * (value - *mean);
}

void ui_pace_add(struct ui_pace *pace, const struct ui_pace *sample)
{
    const double by = pace->frame > 0.0 ? share : 1.0;
    if (sample->frame <= 0.0)
        return;
    mix(&pace->frame, sample->frame, by);
    mix(&pace->device, sample->device, by);
    mix(&pace->screen, sample->screen, by);
    mix(&pace->limit, sample->limit, by);
}

/* Waiting for the screen hides work of the device, not the other way round. */
const char *ui_pace_limit(const struct ui_pace *pace)
{
    if (pace->device > busy * pace->frame)
        return "the device";
    if (pace->limit > waits * pace->frame)
        return "--fps-limit";
    return pace->screen > waits * pace->frame ? "the screen" : "the host";
}
