/* ui_time.c: the line of time below the picture. */
#include <math.h>
#include <stdio.h>
#include "src/view/ui/ui_internal.h"

static const float usual_end = 10.0f; /* seconds, of what has no end of its own */

/* Of an animated model its end; else as far as it takes, in steps. */
static float end_of(const struct ui_view *view)
{
    const struct model *model = &view->picture->scene.model;
    if (model->animation)
        return model->animations[model->animation - 1].seconds;
    return usual_end * fmaxf(ceilf(view->time / usual_end), 1.0f);
}

void ui_time(const struct ui_view *view, struct ui_wish *wish)
{
    char format[64];
    const float end = end_of(view);
    float time = view->time;
    snprintf(format, sizeof(format), "%%.2f of %.4g s", (double)end);
    const struct imgui_slide slide = { 0.0f, end > 0.0f ? end : 1.0f, format, false };
    if (imgui_button(view->paused ? "Play##play" : "Pause##play"))
        wish->action = VIEW_PAUSE;
    imgui_tip("let time pass, or stop it (Space); . and , go on by one frame of motion.fps");
    imgui_same_line(0.0f);
    imgui_next_width(imgui_room());
    if (!imgui_slider("##time", &time, &slide))
        return;
    wish->seeks = true;
    wish->time = time;
}
