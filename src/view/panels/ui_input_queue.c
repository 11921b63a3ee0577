/* ui_input_queue.c: queue that distributes input events over frames for Dear ImGui. */
#define GLFW_INCLUDE_NONE
#include "src/view/panels/ui_input_queue.h"
#include <GLFW/glfw3.h>
#include <string.h>

/* Mapping of GLFW keys to Dear ImGui keys. Of the numeric keypad, only Enter is mapped. */
static const struct {
    int key;
    enum imgui_key means;
    bool with_control; /* the mapping applies only with Ctrl, because the key alone types text */
} keys[] = {
    { GLFW_KEY_TAB, IMGUI_TAB, false },
    { GLFW_KEY_LEFT, IMGUI_LEFT, false },
    { GLFW_KEY_RIGHT, IMGUI_RIGHT, false },
    { GLFW_KEY_UP, IMGUI_UP, false },
    { GLFW_KEY_DOWN, IMGUI_DOWN, false },
    { GLFW_KEY_PAGE_UP, IMGUI_PAGE_UP, false },
    { GLFW_KEY_PAGE_DOWN, IMGUI_PAGE_DOWN, false },
    { GLFW_KEY_HOME, IMGUI_HOME, false },
    { GLFW_KEY_END, IMGUI_END, false },
    { GLFW_KEY_DELETE, IMGUI_DELETE, false },
    { GLFW_KEY_BACKSPACE, IMGUI_BACKSPACE, false },
    { GLFW_KEY_SPACE, IMGUI_SPACE, false },
    { GLFW_KEY_ENTER, IMGUI_ENTER, false },
    { GLFW_KEY_KP_ENTER, IMGUI_ENTER, false },
    { GLFW_KEY_ESCAPE, IMGUI_ESCAPE, false },
    { GLFW_KEY_A, IMGUI_A, true },
    { GLFW_KEY_C, IMGUI_C, true },
    { GLFW_KEY_V, IMGUI_V, true },
    { GLFW_KEY_X, IMGUI_X, true },
    { GLFW_KEY_Z, IMGUI_Z, true },
};

static enum imgui_key find_key(const struct imgui_input *now, const struct window_event *event)
{
    for (size_t i = 0; i < sizeof(keys) / sizeof(keys[0]); i++) {
        if (keys[i].key == event->code &&
            (!keys[i].with_control || event->control || now->keys[keys[i].means]))
            return keys[i].means;
    }
    return IMGUI_KEY_COUNT;
}

static void apply_key(struct imgui_input *now, const struct window_event *event)
{
    const enum imgui_key key = find_key(now, event);
    now->control = event->control;
    now->shift = event->shift;
    now->alt = event->alt;
    if (key != IMGUI_KEY_COUNT)
        now->keys[key] = event->down;
}

static void apply(struct imgui_input *now, const struct window_event *event)
{
    switch (event->kind) {
    case WINDOW_CURSOR:
        now->x = (float)event->x;
        now->y = (float)event->y;
        break;
    case WINDOW_BUTTON:
        if (event->code < IMGUI_BUTTON_COUNT)
            now->buttons[event->code] = event->down;
        break;
    case WINDOW_WHEEL:
        now->wheel += (float)event->y;
        break;
    case WINDOW_KEY:
        apply_key(now, event);
        break;
    case WINDOW_CHARACTER:
        if (now->character_count < IMGUI_CHARACTER_COUNT)
            now->characters[now->character_count++] = (unsigned)event->code;
        break;
    }
}

static bool is_motion(const struct window_event *event)
{
    return event->kind == WINDOW_CURSOR || event->kind == WINDOW_WHEEL;
}

/* Returns true if a frame that has the event `first` can have `event`, too. */
static bool fits(const struct imgui_input *now, const struct window_event *first,
                 const struct window_event *event)
{
    if (first->kind == WINDOW_CHARACTER && event->kind == WINDOW_CHARACTER)
        return now->character_count < IMGUI_CHARACTER_COUNT;
    return is_motion(first) && is_motion(event);
}

static void forget(struct ui_input_queue *input, uint32_t count)
{
    input->event_count -= count;
    memmove(input->events, &input->events[count], input->event_count * sizeof(input->events[0]));
}

void ui_input_queue_add(struct ui_input_queue *input, const struct window_event *event)
{
    struct window_event *last = input->event_count ? &input->events[input->event_count - 1] : NULL;
    if (last && last->kind == WINDOW_CURSOR && event->kind == WINDOW_CURSOR) {
        *last = *event;
        return;
    }
    if (input->event_count == UI_INPUT_QUEUE_COUNT) {
        apply(&input->now, &input->events[0]);
        forget(input, 1);
    }
    input->events[input->event_count++] = *event;
}

void ui_input_queue_step(struct ui_input_queue *input)
{
    const struct window_event *first = NULL;
    uint32_t count = 0;
    input->now.wheel = 0.0f;
    input->now.character_count = 0;
    for (; count < input->event_count; count++) {
        const struct window_event *event = &input->events[count];
        const bool is_known =
            event->kind != WINDOW_KEY || find_key(&input->now, event) != IMGUI_KEY_COUNT;
        if (is_known && first && !fits(&input->now, first, event))
            break;
        first = is_known && !first ? event : first;
        apply(&input->now, event);
    }
    forget(input, count);
}
