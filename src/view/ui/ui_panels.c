/* ui_panels.c: the panels. */
#include <math.h>
#include <stdio.h>
#include "src/scene/material.h"
#include "src/tech/refract.h"
#include "src/view/ui/ui_internal.h"
#include "src/view/ui/ui_plan.h"
#include "src/view/ui/ui_settings.h"

enum {
    MATERIAL_MAX = 16, /* in the list */
    RUNG_MAX = 32,
};

static const char panel[] = "firn";
static const struct imgui_place panel_place = { 8.0f, 8.0f, 330.0f, 620.0f };
static const float side_width = 330.0f; /* of the other panels */
static const float widget_width = 150.0f;

/* Settings that stand above all others, as far as there are such. */
static const char *const often[] = { "refract.crossfade", "cracks.count", "bubbles.count" };

/* ---- the first panel ---- */

/* The index of `rung` in names, which are those of all rungs. */
static uint32_t name_rungs(const char *names[static RUNG_MAX], uint32_t *count,
                           const struct technique *rung)
{
    uint32_t chosen = 0;
    const struct technique *next;
    for (*count = 0; *count < RUNG_MAX && (next = techniques_rung(*count)); ++*count) {
        names[*count] = next->rung.name;
        chosen = rung == next ? *count : chosen;
    }
    return chosen;
}

static void rung_lists(struct ui_wish *wish)
{
    const char *names[RUNG_MAX + 1] = { "none" };
    uint32_t count;
    uint32_t left = name_rungs(&names[1], &count, wish->rung);
    if (imgui_list("refraction", &names[1], count, &left)) {
        wish->rung = techniques_rung(left);
        wish->changed = true;
    }
    imgui_tip("refraction rung; with a divider, the one to its left");
    uint32_t right = wish->split ? name_rungs(&names[1], &count, wish->split) + 1 : 0;
    imgui_next_width(widget_width * imgui_scale());
    if (imgui_list("right of a divider", names, count + 1, &right))
        wish->split = right ? techniques_rung(right - 1) : NULL;
    imgui_tip("refraction rung to the right of the divider (S, [ and ])");
}

/* By its index of refraction: glass and plastic are one. */
static void material_list(struct ui_wish *wish)
{
    const struct setting *ior =
        settings_row(&refract_settings, offsetof(struct refract_params, ior));
    const double is = settings_get(&wish->settings, ior);
    const char *names[MATERIAL_MAX + 1];
    uint32_t count = 0;
    uint32_t chosen = UINT32_MAX;
    for (; material_presets[count].name && count < MATERIAL_MAX; count++) {
        const double difference = (double)material_presets[count].ior - is;
        names[count] = material_presets[count].name;
        if (chosen == UINT32_MAX && !(difference < 0.0 || difference > 0.0))
            chosen = count;
    }
    names[count] = "other";
    chosen = chosen == UINT32_MAX ? count : chosen;
    if (imgui_list("material", names, count + 1, &chosen) && chosen < count) {
        settings_put(&wish->settings, ior, (double)material_presets[chosen].ior);
        wish->changed = true;
    }
    imgui_tip("material of the object: sets refract.ior");
}

static void buttons(struct ui *ui, const struct ui_view *view, struct ui_wish *wish)
{
    static const struct {
        const char *label, *help;
        enum view_action action;
    } rows[] = {
        { "copy command",
          "copy the firn render command of this picture (with a divider, of its left\nside) to the "
          "clipboard, and print it to stdout (C)",
          VIEW_COPY },
        { "screenshot", "save PNG and EXR files, without these panels (P)", VIEW_SCREENSHOT },
        { "camera", "reset the camera (R)", VIEW_RESET },
    };

    if (imgui_button(view->paused ? "resume##time" : "pause##time"))
        wish->action = VIEW_PAUSE;
    imgui_tip("pause or resume the scene's time (Space)");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        imgui_same_line(0.0f);
        if (imgui_button(rows[i].label))
            wish->action = rows[i].action;
        imgui_tip(rows[i].help);
    }
    imgui_checkbox("times", &ui->times_open);
    imgui_same_line(0.0f);
    imgui_checkbox("plan", &ui->plan_open);
    imgui_same_line(0.0f);
    imgui_checkbox("keys", &ui->keys_open);
}

static void head(struct ui *ui, const struct ui_view *view, struct ui_wish *wish)
{
    const struct app_picture *p = &view->picture->state;
    const double frame = ui->pace.frame;
    char text[256];
    snprintf(text, sizeof(text), "%s, %ux%u", p->scene.name, p->width, p->height);
    imgui_text(text);
    snprintf(text, sizeof(text), "%.1f frames per second, %.1f ms each",
             frame > 0.0 ? 1.0 / frame : 0.0, frame * 1e3);
    imgui_text(frame > 0.0 ? text : "no frame has been measured yet");
    snprintf(text, sizeof(text), "limited by %s", ui_pace_limit(&ui->pace));
    imgui_text_dim(frame > 0.0 ? text : "");
    snprintf(
        text, sizeof(text),
        "device time %.1f ms; the host waits %.1f ms for the screen and %.1f ms for --fps-limit",
        ui->pace.device * 1e3, ui->pace.screen * 1e3, ui->pace.limit * 1e3);
    imgui_tip(text);
    if (*ui->fault)
        imgui_warning(ui->fault);
    buttons(ui, view, wish);
    imgui_text_dim(ui->words); /* empty, too: nothing moves when there are some */
}

static void lists(struct ui_wish *wish)
{
    imgui_next_width(widget_width * imgui_scale());
    rung_lists(wish);
    imgui_next_width(widget_width * imgui_scale());
    material_list(wish);
    imgui_id_begin(often);
    for (size_t i = 0; i < sizeof(often) / sizeof(often[0]); i++) {
        const struct setting *row = settings_find(often[i]);
        if (row)
            wish->changed = ui_settings_row(&wish->settings, row, row->name) || wish->changed;
    }
    imgui_id_end();
}

static void search(struct ui *ui, struct ui_wish *wish)
{
    if (ui->focus_search)
        imgui_next_focus();
    imgui_next_width(widget_width * imgui_scale());
    imgui_line_of_text("##filter", "find a setting (/)", ui->filter, sizeof(ui->filter));
    imgui_same_line(0.0f);
    if (imgui_button("reset all")) {
        wish->settings = settings_default();
        wish->changed = true;
    }
    imgui_tip("reset all settings to their defaults");
}

static void main_panel(struct ui *ui, const struct ui_view *view, struct ui_wish *wish)
{
    struct imgui_place place = panel_place;
    place.height = fminf(place.height, (float)view->size.height / ui->scale - 2.0f * place.y);
    if (imgui_panel_begin(ui->imgui, panel, place, NULL)) {
        head(ui, view, wish);
        imgui_separator();
        lists(wish);
        imgui_separator();
        search(ui, wish);
        wish->changed = ui_settings_panel(&wish->settings, ui->filter) || wish->changed;
    }
    imgui_panel_end();
    ui->focus_search = false;
}

/* On the right, below each other as far as there is room. */
static struct imgui_place side_place(const struct ui *ui, const struct ui_view *view, float y,
                                     float height)
{
    const float width = (float)view->size.width / ui->scale;
    return (struct imgui_place){ width - side_width - 8.0f, y, side_width, height };
}

static void keys_panel(void)
{
    const char *name;
    const char *help;
    for (uint32_t i = 0; keys_row(i, &name, &help); i++) {
        imgui_text(name);
        imgui_same_line(110.0f * imgui_scale());
        imgui_text_dim(help);
    }
}

static void other_panels(struct ui *ui, const struct ui_view *view)
{
    if (ui->times_open) {
        if (imgui_panel_begin(ui->imgui, "times", side_place(ui, view, 8.0f, 380.0f),
                              &ui->times_open)) {
            ui_times_panel("the frame", &ui->frame_times);
            if (view->picture->right)
                ui_times_panel("the right frame", &ui->right_times);
            ui_times_panel("the window", &ui->window_times);
        }
        imgui_panel_end();
    }
    if (ui->plan_open && view->picture->renderer) {
        if (imgui_panel_begin(ui->imgui, "plan", side_place(ui, view, 396.0f, 260.0f),
                              &ui->plan_open))
            ui_plan_panel(renderer_frame(view->picture->renderer));
        imgui_panel_end();
    }
    if (ui->keys_open) {
        struct imgui_place place = side_place(ui, view, 60.0f, 420.0f);
        place.x -= 240.0f;
        place.width += 240.0f;
        if (imgui_panel_begin(ui->imgui, "keys", place, &ui->keys_open))
            keys_panel();
        imgui_panel_end();
    }
}

void ui_panels(struct ui *ui, const struct ui_view *view, struct ui_wish *wish)
{
    main_panel(ui, view, wish);
    other_panels(ui, view);
    if (ui->focus_panel)
        imgui_focus_panel(panel);
    ui->focus_panel = false;
}
