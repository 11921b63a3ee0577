/* ui_playback.c: timeline below the image: play button and time slider. */
#include <math.h>
#include <stdio.h>
#include "src/view/panels/ui_internal.h"

static const float default_length = 10.0f; /* length without animation, seconds */

/* Returns the timeline's end in seconds: the animation's end or the next multiple of 10. */
static float end_of(const struct ui_view *view)
{
    const struct model *model = &view->viewport->scene.model;
    if (model->animation)
        return model->animations[model->animation - 1].seconds;
    return default_length * fmaxf(ceilf(view->time / default_length), 1.0f);
}

void ui_timeline(const struct ui_view *view, struct ui_request *request)
{
    char format[64];
    const float end = end_of(view);
    float time = view->time;
    snprintf(format, sizeof(format), "%%.2f of %.4g s", (double)end);
    const struct imgui_slider_range slide = { 0.0f, end > 0.0f ? end : 1.0f, format, false };
    if (imgui_button(view->paused ? "Play##play" : "Pause##play"))
        request->action = VIEW_PAUSE;
    imgui_tooltip("play or pause (Space); comma and full stop step by one frame");
    imgui_same_line(0.0f);
    imgui_next_width(imgui_available_width());
    if (!imgui_slider("##time", &time, &slide))
        return;
    request->seeks = true;
    request->time = time;
}
