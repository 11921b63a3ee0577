/*
 * ui_input.h: what hands do, handed to panels frame by frame.
 *
 * Panels look at how hands stand once a frame, so a click between two frames would be lost, and a
 * drag would begin where it ended. What happened in a frame is therefore spread over as many as it
 * takes: none sees a button move twice, the cursor move after a button, or a button go down where
 * the cursor has just come: there a heading that a button may lie on still belongs to what was
 * below the cursor before.
 */
#ifndef FIRN_VIEW_UI_UI_INPUT_H
#define FIRN_VIEW_UI_UI_INPUT_H

#include "src/view/ui/imgui.h"
#include "src/view/window.h"

enum {
    UI_INPUT_EVENT_COUNT = 128, /* that wait; older ones are merged */
};

struct ui_input {
    struct imgui_input now; /* as the last frame saw it */
    struct window_event events[UI_INPUT_EVENT_COUNT];
    uint32_t event_count;
};

void ui_input_add(struct ui_input *input, const struct window_event *event);

/* input->now becomes what the next frame is to see, but for its seconds and size. */
void ui_input_step(struct ui_input *input);

#endif
