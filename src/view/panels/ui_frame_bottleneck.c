/* ui_frame_bottleneck.c: running means of frame times, and what limits the frame rate. */
#include "src/view/panels/ui_frame_bottleneck.h"
#include <stddef.h>

static const double smoothing = 0.1; /* weight of the newest frame */
static const double busy = 0.8;      /* fraction of frame time above which the GPU is the limit */
static const double waits = 0.3;     /* fraction of frame time above which a wait is the limit */

static void mix(double *mean, double value, double by)
{
    *mean += by * (value - *mean);
}

void ui_frame_pacing_add(struct ui_frame_pacing *pace, const struct ui_frame_pacing *sample)
{
    const double by = pace->frame > 0.0 ? smoothing : 1.0;
    if (sample->frame <= 0.0)
        return;
    mix(&pace->frame, sample->frame, by);
    if (sample->device < 0.0 || pace->device < 0.0)
        pace->device = sample->device;
    else
        mix(&pace->device, sample->device, by);
    mix(&pace->screen, sample->screen, by);
}

/* Checks the device first, because a slow device also prolongs the present wait: the screen is the
 * limit only if the wait clearly exceeds the time of the device. */
const char *ui_frame_pacing_limit(const struct ui_frame_pacing *pace)
{
    if (pace->device < 0.0)
        return NULL;
    if (pace->device > busy * pace->frame)
        return "the device";
    return pace->screen - pace->device > waits * pace->frame ? "the screen" : "the host";
}
