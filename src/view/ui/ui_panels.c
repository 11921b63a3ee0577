/* ui_panels.c: draws the panels: side panel with tabs, shortcut list, labels of compared sides. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/frame/pass_list.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/material.h"
#include "src/settings/quality.h"
#include "src/tech/refract/refract.h"
#include "src/view/ui/ui_internal.h"
#include "src/view/ui/ui_pixel_inspector.h"
#include "src/view/ui/ui_plan_chart.h"
#include "src/view/ui/ui_settings.h"

enum {
    MATERIAL_MAX = 16, /* maximum entries of each list */
    ENVIRONMENT_MAX = 8,
    RUNG_MAX = 32,
    OTHER_COUNT = 3, /* choices for side B that are not refraction models */
};

static const char panel[] = "settings";
static const float gallery_panel = 440.0f; /* minimum height for thumbnails, at scale 1 */

/* Fills in the names of all refraction models. Returns the index of `rung`. */
static uint32_t name_rungs(const char *names[static RUNG_MAX], uint32_t *count,
                           const struct technique *refraction)
{
    uint32_t chosen = 0;
    const struct technique *next;
    for (*count = 0; *count < RUNG_MAX && (next = techniques_refraction(*count)); ++*count) {
        names[*count] = next->refraction.name;
        chosen = refraction == next ? *count : chosen;
    }
    return chosen;
}

const char *ui_environment(uint32_t i)
{
    if (!i--)
        return "sky";
    for (const struct asset *a = assets; a->name; a++) {
        if (a->kind == ASSET_ENVIRONMENT && !i--)
            return a->name;
    }
    return NULL;
}

static void environment_buttons(const struct ui_view *view, struct ui_request *wish)
{
    const char *names[ENVIRONMENT_MAX];
    const char *now = view->picture->state.scene.environment;
    const bool is_sky = view->picture->scene.background == SCENE_SKY;
    uint32_t count = 0;
    uint32_t chosen = is_sky ? 0 : UINT32_MAX;
    for (; count < ENVIRONMENT_MAX && ui_environment(count); count++) {
        names[count] = ui_environment(count);
        chosen = now && !strcmp(now, names[count]) ? count : chosen;
    }
    if (ui_named_buttons("Environment", names, count, &chosen,
                         "surrounding panorama (--env); or drop an .exr or .hdr file") &&
        !wish->open)
        wish->open = strdup(names[chosen]);
}

static void quality_list(struct ui_request *wish)
{
    const char *names[QUALITY_COUNT + 1] = { [QUALITY_COUNT] = "custom" };
    uint32_t level = quality_find(&wish->settings);
    const uint32_t count = level < QUALITY_COUNT ? QUALITY_COUNT : QUALITY_COUNT + 1;
    for (uint32_t i = 0; i < QUALITY_COUNT; i++)
        names[i] = qualities[i].name;
    if (!ui_named_list("Quality preset", names, count, &level,
                       "sets several settings at once: --quality") ||
        level == QUALITY_COUNT)
        return;
    for (const struct quality_row *row = quality_rows; row->setting; row++)
        quality_apply_row(&wish->settings, row, level);
    wish->changed = true;
}

/* Draws the list of side B: none, the refraction models, reference, image file, stored state. */
static void other_list(const struct ui_view *view, struct ui_request *wish, const char **names,
                       uint32_t count)
{
    static const struct {
        enum view_side_b other;
        const char *name;
    } more[OTHER_COUNT] = {
        { VIEW_SIDE_B_REFERENCE, "reference" },
        { VIEW_SIDE_B_FILE, "image file: drop it" },
        { VIEW_SIDE_B_STATE, "stored state (S)" },
    };

    const uint32_t more_count = view->has_stored ? OTHER_COUNT : OTHER_COUNT - 1;
    uint32_t chosen = 0;
    for (uint32_t i = 1; i < count; i++)
        chosen = wish->other == VIEW_SIDE_B_MODEL && wish->split == techniques_refraction(i - 1)
                     ? i
                     : chosen;
    for (uint32_t i = 0; i < more_count; i++) {
        names[count + i] = more[i].name;
        chosen = wish->other == more[i].other ? count + i : chosen;
    }
    if (!ui_named_list("Compare with", names, count + more_count, &chosen,
                       "side B, right of the divider (W, [ and ])"))
        return;
    wish->split = chosen && chosen < count ? techniques_refraction(chosen - 1) : NULL;
    wish->other = !chosen       ? VIEW_SIDE_B_NONE
                  : wish->split ? VIEW_SIDE_B_MODEL
                                : more[chosen - count].other;
}

/* Returns the thumbnail, or none in low panels, which lack the room. */
static uint32_t picture_if_high(const struct ui *ui, const struct ui_view *view, uint32_t picture)
{
    const float height = (float)view->layout->panel.extent.height;
    return height < gallery_panel * ui->scale ? UI_THUMBNAIL_NONE : picture;
}

static void rung_lists(const struct ui *ui, const struct ui_view *view, struct ui_request *wish)
{
    const char *names[RUNG_MAX + 1 + OTHER_COUNT] = { "none" };
    const char *tips[RUNG_MAX];
    uint32_t count;
    uint32_t left = name_rungs(&names[1], &count, wish->refraction);
    for (uint32_t i = 0; i < count; i++)
        tips[i] = techniques_refraction(i)->help;
    const struct ui_gallery gallery = {
        .name = "Refraction model",
        .words = "Refraction model",
        .names = &names[1],
        .tips = tips,
        .first_picture = picture_if_high(ui, view, ui_thumbnails_model(ui->pictures, 0)),
        .count = count,
    };
    if (ui_gallery(&gallery, &left)) {
        wish->refraction = techniques_refraction(left);
        wish->changed = true;
    }
    other_list(view, wish, names, count + 1);
}

/* Draws the material presets; the current one is recognised by its refractive index alone. */
static void material_buttons(const struct ui *ui, const struct ui_view *view,
                             struct ui_request *wish)
{
    const struct setting *ior =
        settings_row(&refract_settings, offsetof(struct refract_params, ior));
    const double is = settings_get(&wish->settings, ior);
    const char *names[MATERIAL_MAX];
    const char *tips[MATERIAL_MAX];
    uint32_t count = 0;
    uint32_t chosen = UINT32_MAX;
    for (; material_presets[count].name && count < MATERIAL_MAX; count++) {
        const double difference = (double)material_presets[count].ior - is;
        names[count] = material_presets[count].name;
        tips[count] = material_presets[count].help;
        if (chosen == UINT32_MAX && !(difference < 0.0 || difference > 0.0))
            chosen = count;
    }
    const struct ui_gallery gallery = {
        .name = "Material preset",
        .words = "Material",
        .names = names,
        .tips = tips,
        .first_picture = picture_if_high(ui, view, ui_thumbnails_material(ui->pictures, 0)),
        .count = count,
    };
    if (ui_gallery(&gallery, &chosen)) {
        settings_set_value(&wish->settings, ior, (double)material_presets[chosen].ior);
        wish->changed = true;
    }
}

/* Draws the controls of a group that are not settings. */
static void lists(const struct ui *ui, enum ui_setting_group group, const struct ui_view *view,
                  struct ui_request *wish)
{
    if (group == UI_MATERIAL)
        material_buttons(ui, view, wish);
    if (group == UI_LIGHT)
        environment_buttons(view, wish);
    if (group == UI_QUALITY) {
        quality_list(wish);
        rung_lists(ui, view, wish);
    }
}

static void groups(struct ui *ui, const struct ui_view *view, const struct ui_settings *settings,
                   struct ui_request *wish)
{
    for (enum ui_setting_group g = UI_OBJECT; g < UI_GROUP_COUNT; g++) {
        imgui_id_begin(ui_setting_groups_name(g));
        wish->changed = ui_settings_heading(settings, g, &ui->open[g]) || wish->changed;
        if (ui->open[g]) {
            lists(ui, g, view, wish);
            wish->changed = ui_settings_group(settings, g, &ui->more[g]) || wish->changed;
        }
        imgui_id_end();
    }
}

static void search(struct ui *ui, const struct settings *usual, struct ui_request *wish)
{
    static const char all[] = "Reset all";
    if (ui->focus_search)
        imgui_next_focus();
    imgui_next_width(imgui_available_width() - imgui_width(all) - 6.0f * imgui_scale());
    imgui_text_field("##search", "search settings (/)", ui->filter, sizeof(ui->filter));
    imgui_same_line(0.0f);
    if (imgui_button(all)) {
        wish->settings = *usual;
        wish->changed = true;
    }
    imgui_tooltip("reset all settings to the scene's values");
}

static void settings_tab(struct ui *ui, const struct ui_view *view, struct ui_request *wish)
{
    const struct scene *scene = &view->picture->scene;
    const struct settings own = app_scene_settings(&view->picture->state.scene, scene);
    const struct settings usual = frame_settings(&own, scene);
    const struct ui_settings settings = { &wish->settings, &usual };
    search(ui, &usual, wish);
    imgui_scroll_begin("rows");
    if (*ui->filter)
        wish->changed = ui_settings_found(&settings, ui->filter) || wish->changed;
    else
        groups(ui, view, &settings, wish);
    imgui_scroll_end();
}

/* Draws the memory of the image's plan, and the log of slow changes with their reasons. */
static void costs(const struct ui_view *view)
{
    const struct renderer *renderer = viewport_renderer(view->picture, false);
    const char *words = rebuild_log_at(view->reloads, 0);
    if (renderer)
        ui_plan_chart_memory(renderer_frame(renderer));
    imgui_text_dim(words ? "slow changes:" : "no slow changes");
    imgui_tooltip(
        "changes that took longer than a frame, newest first; tooltips of settings tell what "
        "they rebuild");
    for (uint32_t i = 0; (words = rebuild_log_at(view->reloads, i)); i++)
        imgui_text_wrapped(words);
}

static void times_tab(const struct ui *ui, const struct ui_view *view)
{
    imgui_scroll_begin("times");
    costs(view);
    ui_pass_times_panel("frame", &ui->frame_times);
    if (view->picture->right)
        ui_pass_times_panel("side B", &ui->right_times);
    ui_pass_times_panel("window", &ui->window_times);
    imgui_scroll_end();
}

static void plan_tab(const struct ui_view *view)
{
    imgui_scroll_begin("plan");
    const struct renderer *renderer = viewport_renderer(view->picture, false);
    if (renderer)
        ui_plan_chart_panel(renderer_frame(renderer));
    imgui_scroll_end();
}

static void tabs(struct ui *ui)
{
    static const struct {
        const char *label, *tip;
    } rows[] = {
        [UI_SETTINGS] = { "Settings", "settings of scene and rendering" },
        [UI_TIMES] = { "Passes", "time of each pass (B)" },
        [UI_PLAN] = { "Plan", "compiled render graph of the frame (G)" },
        [UI_INSPECT] = { "Inspect", "layers, histogram, values below the cursor (I)" },
    };

    for (enum ui_tab t = UI_SETTINGS; t <= UI_INSPECT; t++) {
        if (t != UI_SETTINGS)
            imgui_same_line(0.0f);
        if (imgui_choice_button(rows[t].label, ui->tab == t))
            ui->tab = t;
        imgui_tooltip(rows[t].tip);
    }
}

static void side_panel(struct ui *ui, const struct ui_view *view, struct ui_request *wish)
{
    if (ui->focus_search)
        ui->tab = UI_SETTINGS;
    tabs(ui);
    if (*ui->fault)
        imgui_warning(ui->fault);
    if (ui->tab == UI_SETTINGS)
        settings_tab(ui, view, wish);
    else if (ui->tab == UI_TIMES)
        times_tab(ui, view);
    else if (ui->tab == UI_INSPECT)
        ui_pixel_inspector_panel(ui, view, wish);
    else
        plan_tab(view);
    ui->focus_search = false;
}

/* Draws the shortcut list in the middle of the window, in two columns if it is wide enough. Row
 * spacing adapts to the window's height; if that is not enough, the list scrolls. */
static void keys_panel(struct ui *ui, const struct ui_view *view)
{
    const char *name;
    const char *help;
    uint32_t count = 0;
    while (key_bindings_row(count, &name, &help))
        count++;
    const float scale = ui->scale;
    const float width = fminf(728.0f * scale, (float)view->size.width);
    const uint32_t columns = width < 600.0f * scale ? 1 : 2;
    const uint32_t rows = (count + columns - 1) / columns;
    const float room = (float)view->size.height - 16.0f * scale; /* without the panel's padding */
    const float line = imgui_line_height();
    const float gap = fmaxf(fminf(4.0f * scale, room / (float)rows - line), scale);
    const float height =
        fminf((float)rows * (line + gap) + 16.0f * scale, (float)view->size.height);
    const struct imgui_rect place = { ((float)view->size.width - width) / 2.0f,
                                      ((float)view->size.height - height) / 2.0f, width, height };
    imgui_panel_begin(ui->imgui, "keys", place, IMGUI_POPUP);
    imgui_gap_begin(gap);
    imgui_scroll_begin("##keys");
    const float column = imgui_available_width() / (float)columns;
    for (uint32_t i = 0; i < rows; i++) {
        for (uint32_t c = 0; c < columns && key_bindings_row(i + c * rows, &name, &help); c++) {
            const float x = 8.0f * scale + (float)c * column;
            if (c)
                imgui_same_line(x);
            imgui_text_in(name, ui->theme->accent);
            imgui_name(name);
            imgui_same_line(x + 112.0f * scale);
            imgui_text_elided(help, column - 122.0f * scale);
        }
    }
    imgui_scroll_end();
    imgui_gap_end();
    imgui_panel_end();
}

/* Draws the label of a side over a corner of the image, the only panel that covers it. */
static void name_side(struct ui *ui, const struct ui_view *view, const char *name, bool is_right)
{
    const struct present_area *p = view->place;
    const float width = fminf(imgui_width(name) + 8.0f * ui->scale, 0.48f * (float)p->width);
    const float height = imgui_line_height() + 10.0f * ui->scale;
    const struct imgui_rect place = {
        (float)p->x + (is_right ? (float)p->width - width : 0.0f),
        (float)(p->y + p->height) - height,
        width,
        height,
    };
    imgui_panel_begin(ui->imgui, is_right ? "right" : "left", place, IMGUI_LABEL);
    imgui_text_elided(name, imgui_available_width());
    imgui_name(name);
    imgui_panel_end();
}

static void name_sides(struct ui *ui, const struct ui_view *view)
{
    const bool flipped = view->picture->flipped;
    if (view->other == VIEW_SIDE_B_NONE || !view->place->width)
        return;
    name_side(ui, view, flipped ? view->right : view->left, false);
    if (!flipped)
        name_side(ui, view, view->right, true);
}

void ui_panels(struct ui *ui, const struct ui_view *view, struct ui_request *wish)
{
    const struct window_layout *l = view->layout;
    if (ui->focus_panel || ui->release)
        /* before its first widget, which gets the focus highlight */
        imgui_focus_panel(ui->release ? NULL : panel);
    ui->focus_panel = ui->release = false;
    if (l->panel.extent.width) {
        imgui_panel_begin(ui->imgui, "bar", ui_rect_of(l->bar), IMGUI_DOCKED);
        ui_toolbar(view, wish);
        imgui_panel_end();
        imgui_panel_begin(ui->imgui, panel, ui_rect_of(l->panel), IMGUI_DOCKED);
        side_panel(ui, view, wish);
        imgui_panel_end();
        if (l->strip.extent.height) {
            imgui_panel_begin(ui->imgui, "time", ui_rect_of(l->strip), IMGUI_DOCKED);
            ui_timeline(view, wish);
            imgui_panel_end();
        }
        imgui_panel_begin(ui->imgui, "status", ui_rect_of(l->status), IMGUI_DOCKED);
        ui_status(ui, view);
        imgui_panel_end();
    }
    name_sides(ui, view);
    if (ui->palette_open)
        ui_command_palette(ui, view, wish);
    if (ui->keys_open)
        keys_panel(ui, view);
}
