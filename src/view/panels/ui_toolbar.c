/* ui_toolbar.c: toolbar above the image and status bar below it. */
#include <stdio.h>
#include "src/tech/output/tonemap.h"
#include "src/view/panels/ui_internal.h"
#include "src/view/panels/ui_pixel_inspector.h"

/* Buttons from left to right; in narrow windows the last ones are omitted. */
static const struct button {
    enum view_action action;
    const char *label;
} buttons[] = {
    { VIEW_PAUSE, "Pause" }, { VIEW_PALETTE, "Find" },  { VIEW_HELP, "Keys" },
    { VIEW_UNDO, "Undo" },   { VIEW_REDO, "Redo" },     { VIEW_SCREENSHOT, "Save" },
    { VIEW_COPY, "Copy" },   { VIEW_SPLIT, "Compare" }, { VIEW_RESET, "Reset view" },
};

enum {
    BUTTON_COUNT = sizeof(buttons) / sizeof(buttons[0]),
};

static const float slot_width = 130.0f;   /* width of slider and layer list, pixels at scale 1 */
static const float exposure_reach = 6.0f; /* stops; the setting itself allows more */
static const float name_width = 60.0f;    /* minimum scene name width, scale 1 */

struct imgui_rect ui_rect_of(VkRect2D r)
{
    return (struct imgui_rect){ (float)r.offset.x, (float)r.offset.y, (float)r.extent.width,
                                (float)r.extent.height };
}

static const char *label_of(const struct ui_view *view, const struct button *button)
{
    return button->action == VIEW_PAUSE && view->paused ? "Play" : button->label;
}

static void tip(enum view_action action)
{
    char text[320];
    snprintf(text, sizeof(text), "%s (%s)", key_bindings_help(action), key_bindings[action].keys);
    imgui_tooltip(text);
}

static bool is_disabled(const struct ui_view *view, enum view_action action)
{
    const struct undo_stack *h = view->undo_stack;
    return (action == VIEW_UNDO && !h->at) || (action == VIEW_REDO && h->at + 1 >= h->count);
}

static void exposure(float width, struct ui_request *request)
{
    const struct setting *row =
        settings_row(&tonemap_settings, offsetof(struct tonemap_values, exposure));
    const struct imgui_slider_range slide = { -exposure_reach, exposure_reach, "%+.2f stops",
                                              false };
    float stops = (float)settings_get(&request->settings, row);
    imgui_next_width(width);
    if (imgui_slider("##exposure", &stops, &slide)) {
        settings_set_value(&request->settings, row, (double)stops);
        request->changed = true;
    }
    imgui_tooltip("exposure in stops (setting tonemap.exposure); E raises and Shift+E lowers it by "
                  "half a stop");
}

void ui_toolbar(const struct ui_view *view, struct ui_request *request)
{
    const float gap = 6.0f * imgui_scale();
    const float room = imgui_available_width();
    const float min_width = name_width * imgui_scale();
    float width = 0.0f;
    uint32_t count = 0;
    while (count < BUTTON_COUNT) {
        const float more = imgui_width(label_of(view, &buttons[count])) + gap;
        if (width + more + min_width > room)
            break;
        width += more;
        count++;
    }
    const float slot = slot_width * imgui_scale();
    const bool exposes = count == BUTTON_COUNT && width + slot + min_width < room;
    const bool lists = exposes && width + 2.0f * slot + min_width < room;
    float x = room - width - (exposes ? slot : 0.0f) - (lists ? slot : 0.0f);
    imgui_align();
    imgui_text_elided(view->viewport->state.scene.name, x - gap);
    imgui_tooltip(view->viewport->state.scene.name);
    if (lists) {
        imgui_same_line(x + gap);
        imgui_next_width(slot - gap);
        ui_pixel_inspector_layer_list("##shown layer", &request->inspector_choice);
        x += slot;
    }
    if (exposes) {
        imgui_same_line(x + gap);
        exposure(slot - gap, request);
    }
    for (uint32_t i = 0; i < count; i++) {
        const enum view_action action = buttons[i].action;
        const char *label = label_of(view, &buttons[i]);
        imgui_same_line(i ? 0.0f : room - width + gap);
        imgui_disabled_begin(is_disabled(view, action));
        if (action == VIEW_SPLIT ? imgui_choice_button(label, view->side_b != VIEW_SIDE_B_NONE)
                                 : imgui_button(label))
            request->action = action;
        imgui_disabled_end();
        tip(action);
    }
}

static void print_pace(const struct ui *ui, const struct ui_view *view, char *text, size_t size)
{
    const struct setup_image *p = &view->viewport->state;
    const double frame = ui->pace.frame;
    const VkExtent2D drawn = view->viewport->extent;
    const struct draft_renderer *draft = &view->viewport->draft;
    const bool by_bounce = view->viewport->shows_draft && draft->level == DRAFT_RENDERER_BOUNCE;
    char left[32] = "";
    if (view->seconds_left >= 0.5)
        snprintf(left, sizeof(left), ", %.0f s left", view->seconds_left);
    if (view->sample_count)
        snprintf(text, size, "%u\xc3\x97%u  %u/%u%s", p->width, p->height, view->sample_count,
                 view->sample_goal, left);
    else if (frame > 0.0)
        snprintf(text, size, "%u\xc3\x97%u  %.1f ms: %s%s", drawn.width, drawn.height, frame * 1e3,
                 ui_frame_pacing_limit(&ui->pace), by_bounce ? ", moving: bounce" : "");
    else
        snprintf(text, size, "%u\xc3\x97%u", drawn.width, drawn.height);
}

/* Draws a progress bar of the samples along the lower edge of the image. */
static void show_progress(const struct ui_view *view)
{
    struct imgui_rect line = ui_rect_of(view->layout->image);
    line.y += line.height;
    line.height = 2.0f * imgui_scale();
    line.width *= (float)view->sample_count / (float)view->sample_goal;
    if (view->sample_count < view->sample_goal)
        imgui_rectangle(line, imgui_rgba(imgui_theme()->accent));
}

static const char hint[] =
    "drag: orbit, Ctrl drag: light, wheel: zoom, F1: keys; drop files to open";

void ui_status(const struct ui *ui, const struct ui_view *view)
{
    char pace[96];
    char text[256];
    const struct theme *theme = imgui_theme();
    const float room = imgui_available_width();
    print_pace(ui, view, pace, sizeof(pace));
    show_progress(view);
    const float width = imgui_width(pace);
    const char *message = *ui->error         ? ui->error
                          : *ui->message     ? ui->message
                          : view->shows_hint ? hint
                                             : "";
    imgui_text_elided_in(message, room - width,
                         *ui->error || ui->is_failure ? theme->error : theme->text);
    imgui_name(message);
    if (message != hint && *message)
        imgui_tooltip(message);
    imgui_same_line(room - width + 10.0f * imgui_scale());
    imgui_text_dim(pace);
    imgui_name(pace);
    snprintf(text, sizeof(text),
             "%.1f frames per second, limited by %s: device time %.1f ms; the host waits %.1f ms "
             "for the screen",
             ui->pace.frame > 0.0 ? 1.0 / ui->pace.frame : 0.0, ui_frame_pacing_limit(&ui->pace),
             ui->pace.device * 1e3, ui->pace.screen * 1e3);
    imgui_tooltip(text);
}
