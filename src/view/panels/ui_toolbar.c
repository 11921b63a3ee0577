/* ui_toolbar.c: toolbar above the image and status bar below it. */
#include <stdio.h>
#include "src/tech/output/tonemap.h"
#include "src/view/panels/ui_internal.h"
#include "src/view/panels/ui_pixel_inspector.h"

/* Buttons from left to right; in narrow windows the last ones are in a menu. */
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
    DURATION_SIZE = 32,
};

static const char menu_label[] = "...##menu";
static const float slot_width = 130.0f;   /* width of slider and layer list, pixels at scale 1 */
static const float exposure_reach = 6.0f; /* stops; the setting itself allows more */
static const float wide_window = 860.0f;  /* from this width on, the status bar has more words */
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

/* Draws a button of the toolbar. */
static void draw_button(const struct ui_view *view, const struct button *button,
                        struct ui_request *request)
{
    const enum view_action action = button->action;
    const char *label = label_of(view, button);
    imgui_disabled_begin(is_disabled(view, action));
    if (action == VIEW_SPLIT ? imgui_choice_button(label, view->side_b != VIEW_SIDE_B_NONE)
                             : imgui_button(label))
        request->action = action;
    imgui_disabled_end();
    tip(action);
}

/* Draws the menu of what does not fit on the toolbar: buttons from `first` on, and both lists. */
static void draw_menu(const struct ui_view *view, uint32_t first, struct ui_request *request)
{
    const float width = 1.5f * slot_width * imgui_scale();
    if (!imgui_menu_begin(menu_label))
        return;
    for (uint32_t i = first; i < BUTTON_COUNT; i++) {
        imgui_disabled_begin(is_disabled(view, buttons[i].action));
        if (imgui_selectable(label_of(view, &buttons[i]), false))
            request->action = buttons[i].action;
        imgui_disabled_end();
        tip(buttons[i].action);
    }
    imgui_text_dim("Exposure");
    exposure(width, request);
    imgui_text_dim("Layer");
    imgui_next_width(width);
    ui_pixel_inspector_layer_list("##shown layer", &request->inspector_choice);
    imgui_menu_end();
}

/* Parts of the toolbar that fit, from right to left: buttons, exposure, list of layers. */
struct toolbar {
    uint32_t count; /* buttons */
    float width;    /* of the buttons, and of the menu if something does not fit */
    bool exposes, lists;
};

static struct toolbar fit_toolbar(const struct ui_view *view, float room, float gap)
{
    const float slots = 2.0f * slot_width * imgui_scale();
    const float min_width = name_width * imgui_scale();
    float all = 0.0f;
    for (uint32_t i = 0; i < BUTTON_COUNT; i++)
        all += imgui_width(label_of(view, &buttons[i])) + gap;
    if (all + slots + min_width < room)
        return (struct toolbar){ BUTTON_COUNT, all, true, true };
    struct toolbar bar = { .width = imgui_width(menu_label) + gap };
    bar.exposes = all + bar.width + slots / 2.0f + min_width < room;
    while (bar.count < BUTTON_COUNT) {
        const float more = imgui_width(label_of(view, &buttons[bar.count])) + gap;
        if (bar.width + more + min_width > room)
            break;
        bar.width += more;
        bar.count++;
    }
    return bar;
}

void ui_toolbar(const struct ui_view *view, struct ui_request *request)
{
    const float gap = 6.0f * imgui_scale();
    const float room = imgui_available_width();
    const float slot = slot_width * imgui_scale();
    const struct toolbar bar = fit_toolbar(view, room, gap);
    float x = room - bar.width - (bar.exposes ? slot : 0.0f) - (bar.lists ? slot : 0.0f);
    imgui_align();
    imgui_text_elided(view->viewport->state.scene.name, x - gap);
    imgui_tooltip(view->viewport->state.scene.name);
    if (bar.lists) {
        imgui_same_line(x + gap);
        imgui_next_width(slot - gap);
        ui_pixel_inspector_layer_list("##shown layer", &request->inspector_choice);
        x += slot;
    }
    if (bar.exposes) {
        imgui_same_line(x + gap);
        exposure(slot - gap, request);
    }
    for (uint32_t i = 0; i < bar.count; i++) {
        imgui_same_line(i ? 0.0f : room - bar.width + gap);
        draw_button(view, &buttons[i], request);
    }
    if (bar.lists)
        return;
    imgui_same_line(bar.count ? 0.0f : room - bar.width + gap);
    draw_menu(view, bar.count, request);
}

/* Writes a duration, such as "5 s" or "12 min". */
static void print_duration(double seconds, char text[static DURATION_SIZE])
{
    if (seconds < 90.0)
        snprintf(text, DURATION_SIZE, seconds < 1.0 ? "%.1f s" : "%.0f s", seconds);
    else
        snprintf(text, DURATION_SIZE, "%.0f min", seconds / 60.0);
}

/* Writes the progress of the samples; in narrow windows without the time of one. */
static void print_progress(const struct ui_view *view, char *text, size_t size)
{
    const bool is_wide = (float)view->size.width > wide_window * imgui_scale();
    const bool is_long = view->seconds_left >= 0.5;
    char each[DURATION_SIZE];
    char left[DURATION_SIZE];
    print_duration(view->sample_seconds, each);
    print_duration(view->seconds_left, left);
    if (view->is_stopped)
        snprintf(text, size, "%u/%u, stopped; Esc continues", view->sample_count,
                 view->sample_goal);
    else if (view->sample_count && is_long && is_wide)
        snprintf(text, size, "%u/%u, %s per sample, %s left; Esc stops", view->sample_count,
                 view->sample_goal, each, left);
    else if (view->sample_count)
        snprintf(text, size, "%u/%u%s%s%s", view->sample_count, view->sample_goal,
                 is_long ? ", " : "", is_long ? left : "", is_long ? " left" : "");
    else if (view->sample_seconds > 0.0 && is_wide) {
        print_duration(view->sample_seconds * view->sample_goal, left);
        snprintf(text, size, "drawing, %s per sample, %u samples in %s; Esc stops", each,
                 view->sample_goal, left);
    } else
        snprintf(text, size, "drawing; Esc stops");
}

static void print_pace(const struct ui *ui, const struct ui_view *view, char *text, size_t size)
{
    const struct setup_image *p = &view->viewport->state;
    const double frame = ui->pace.frame;
    const VkExtent2D drawn = view->viewport->extent;
    const struct draft_renderer *draft = &view->viewport->draft;
    const bool by_bounce = view->viewport->shows_draft && draft->level == DRAFT_RENDERER_BOUNCE;
    const char *limit = ui_frame_pacing_limit(&ui->pace);
    if (view->sample_count || view->is_first_sample || view->is_stopped) {
        const int length = snprintf(text, size, "%u\xc3\x97%u  ", p->width, p->height);
        print_progress(view, text + length, size - (size_t)length);
    } else if (frame > 0.0)
        snprintf(text, size, "%u\xc3\x97%u  %.1f ms%s%s%s", drawn.width, drawn.height, frame * 1e3,
                 limit ? ": " : "", limit ? limit : "", by_bounce ? ", moving: bounce" : "");
    else
        snprintf(text, size, "%u\xc3\x97%u", drawn.width, drawn.height);
}

/* Draws a progress bar of the samples along the lower edge of the image. */
static void show_progress(const struct ui_view *view)
{
    struct imgui_rect line = ui_rect_of(view->layout->image);
    line.y += line.height;
    line.height = 3.0f * imgui_scale();
    line.width *= (float)view->sample_count / (float)view->sample_goal;
    if (view->sample_count && view->sample_count < view->sample_goal)
        imgui_rectangle(line, imgui_rgba(imgui_theme()->accent));
}

/* Writes the frame rate and, if they were measured, the times that limit it. */
static void print_pace_tip(const struct ui *ui, char *text, size_t size)
{
    const char *limit = ui_frame_pacing_limit(&ui->pace);
    const double rate = ui->pace.frame > 0.0 ? 1.0 / ui->pace.frame : 0.0;
    if (limit)
        snprintf(text, size,
                 "%.1f frames per second, limited by %s: device time %.1f ms; the host waits %.1f "
                 "ms for the screen",
                 rate, limit, ui->pace.device * 1e3, ui->pace.screen * 1e3);
    else
        snprintf(text, size,
                 "%.1f frames per second; passes of moving images have no timestamps, so what "
                 "limits them is not known",
                 rate);
}

static const char hint[] =
    "drag: orbit, Ctrl drag: light, wheel: zoom, F1: keys; drop files to open";

void ui_status(const struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    char pace[128];
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
    const bool refines =
        view->is_stopped || view->is_first_sample || view->sample_count % view->sample_goal;
    if (refines && imgui_is_item_clicked())
        request->action = VIEW_STOP;
    if (refines)
        snprintf(text, sizeof(text), "%s (Esc, or click here)", key_bindings_help(VIEW_STOP));
    else
        print_pace_tip(ui, text, sizeof(text));
    imgui_tooltip(text);
}
