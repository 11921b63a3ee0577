/* ui_input_queue.h: distributes input events over the frames of the panels. Dear ImGui reads the
 * input state once per frame, so a press and release between two frames would be lost, and a drag
 * would start where it ended. Events are therefore spread over several frames: a frame has
 * movements of cursor and wheel, or typed characters, or one change of a button or key. */
#ifndef FIRN_VIEW_PANELS_UI_INPUT_QUEUE_H
#define FIRN_VIEW_PANELS_UI_INPUT_QUEUE_H

#include "src/view/panels/imgui.h"
#include "src/view/window/window.h"

enum {
    UI_INPUT_QUEUE_COUNT = 128, /* capacity in events; a full queue applies its oldest event */
};

struct ui_input_queue {
    struct imgui_input now; /* input state of the last frame */
    struct window_event events[UI_INPUT_QUEUE_COUNT];
    uint32_t event_count;
};

void ui_input_queue_add(struct ui_input_queue *input, const struct window_event *event);

/* Applies the next frame's events to input->now. The caller sets now.seconds, width and height. */
void ui_input_queue_step(struct ui_input_queue *input);

#endif
