/* ui_panels.c: draws the panels: side panel with tabs, shortcut list, labels of compared sides. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/render/frame/pass_list.h"
#include "src/settings/quality.h"
#include "src/setup/setup_material.h"
#include "src/tech/frame_media.h"
#include "src/tech/refract/refract.h"
#include "src/tech/trace/refract_trace.h"
#include "src/view/panels/ui_internal.h"
#include "src/view/panels/ui_objects.h"
#include "src/view/panels/ui_pixel_inspector.h"
#include "src/view/panels/ui_settings.h"

enum {
    MATERIAL_MAX = 96, /* maximum number of material presets */
    REFRACTION_MAX = 32,
    OTHER_COUNT = 3, /* side-B choices besides the refraction models */
};

static const char panel[] = "settings";
static const double mebi = 1024.0 * 1024.0;
static const float gallery_panel = 440.0f; /* panel height for thumbnails, scale 1 */

/* Lists the names of all refraction models. Returns the index of the current one. */
static uint32_t name_refraction_models(const char *names[static REFRACTION_MAX], uint32_t *count,
                                       const struct technique *refraction)
{
    uint32_t chosen = 0;
    const struct technique *next;
    for (*count = 0; *count < REFRACTION_MAX && (next = techniques_refraction(*count)); ++*count) {
        names[*count] = next->refraction.name;
        chosen = refraction == next ? *count : chosen;
    }
    return chosen;
}

static void quality_list(struct ui_request *request)
{
    const char *names[QUALITY_COUNT + 1] = { [QUALITY_COUNT] = "custom" };
    uint32_t level = quality_find(&request->settings);
    const uint32_t count = level < QUALITY_COUNT ? QUALITY_COUNT : QUALITY_COUNT + 1;
    for (uint32_t i = 0; i < QUALITY_COUNT; i++)
        names[i] = qualities[i].name;
    if (!ui_named_list("Quality preset", names, count, &level,
                       "sets several settings at once: --quality") ||
        level == QUALITY_COUNT)
        return;
    quality_apply(&request->settings, level, SETTING_USER);
    request->changed = true;
}

/* Draws the list that selects the image on side B, such as a refraction model or image file. */
static void list_side_b(const struct ui_view *view, struct ui_request *request, const char **names,
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
        chosen =
            request->side_b == VIEW_SIDE_B_MODEL && request->split == techniques_refraction(i - 1)
                ? i
                : chosen;
    for (uint32_t i = 0; i < more_count; i++) {
        names[count + i] = more[i].name;
        chosen = request->side_b == more[i].other ? count + i : chosen;
    }
    if (!ui_named_list("Compare with", names, count + more_count, &chosen,
                       "side B, right of the divider (W, [ and ])"))
        return;
    request->split = chosen && chosen < count ? techniques_refraction(chosen - 1) : NULL;
    request->side_b = !chosen          ? VIEW_SIDE_B_NONE
                      : request->split ? VIEW_SIDE_B_MODEL
                                       : more[chosen - count].other;
}

/* Returns `thumbnails`, or NULL if none is loaded or the panel is not high enough for them. */
static const uint32_t *thumbnails_if_high(const struct ui *ui, const struct ui_view *view,
                                          const uint32_t *thumbnails)
{
    const float height = (float)view->layout->panel.extent.height;
    const bool is_high = height >= gallery_panel * ui->scale;
    return is_high && ui->thumbnails->list.count ? thumbnails : NULL;
}

static void refraction_lists(const struct ui *ui, const struct ui_view *view,
                             struct ui_request *request)
{
    const char *names[REFRACTION_MAX + 1 + OTHER_COUNT] = { "none" };
    const char *tips[REFRACTION_MAX];
    uint32_t count;
    uint32_t left = name_refraction_models(&names[1], &count, request->refraction);
    for (uint32_t i = 0; i < count; i++)
        tips[i] = techniques_refraction(i)->help;
    const struct ui_gallery gallery = {
        .name = "Refraction model",
        .heading = "Refraction model",
        .names = &names[1],
        .tooltips = tips,
        .thumbnails = thumbnails_if_high(ui, view, ui->thumbnails->models),
        .count = count,
    };
    if (ui_gallery(&gallery, &left)) {
        request->refraction = techniques_refraction(left);
        request->changed = true;
    }
    list_side_b(view, request, names, count + 1);
}

/* Returns the factor on absorption coefficients of presets for the scene shown. */
static float absorption_scale(const struct ui_view *view)
{
    return setup_absorption_scale(view->viewport->state.scene.name, &view->viewport->scene);
}

/* Applies a preset and a finish to the selected object. Without a selection, changes the settings
 * if they define the objects' material, else replaces all materials of the model. A rough finish
 * selects the refraction model `trace`. */
static void choose_material(const struct ui_view *view, struct ui_request *request,
                            const struct material_choice *choice)
{
    const struct scene *scene = &view->viewport->scene;
    if (ui_objects_have_own_material(view)) {
        ui_objects_choose_material(view, request, choice);
        return;
    }
    if (!scene->model.object.index_count || !frame_media_are_from_settings(scene)) {
        request->material = *choice;
        return;
    }
    setup_set_material(&request->settings, choice, absorption_scale(view));
    if (choice->finish && !request->refraction->refraction.traces_bvh)
        request->refraction = &refract_trace;
    request->changed = true;
}

/* Returns the finish with the current roughness; NULL for any other. */
static const struct material_finish *find_finish(const struct ui_request *request)
{
    const struct refract_params *refract = settings_of(&request->settings, &refract_settings);
    for (const struct material_finish *f = material_finishes; f->name; f++) {
        if (fabsf(f->roughness - refract->roughness) < 1e-4f)
            return f;
    }
    return NULL;
}

/* Draws the choice of a kind of material, which follows the current preset. */
static void kind_list(struct ui *ui, const struct material_preset *is)
{
    if (is && is != ui->last_material)
        ui->material_kind = is->kind;
    ui->last_material = is;
    ui_named_list("Kind", material_kind_names, MATERIAL_KIND_COUNT, &ui->material_kind,
                  "kind of the materials shown below");
}

/* Returns the material of the selected object, else of all objects; preset NULL if unknown. */
static struct material_choice current_material(const struct ui_view *view,
                                               const struct ui_request *request)
{
    const struct scene *scene = &view->viewport->scene;
    const struct material_override *override = ui_objects_override(view);
    const struct scene_object *object = ui_objects_selected(view);
    struct material_choice is = { 0 };
    if (override) {
        const char *name = &override->words[strlen(override->name) + 1];
        material_choice_parse(&is, name, strcspn(name, ","));
    } else if (ui_objects_have_own_material(view)) {
        if (object->is_refractive)
            material_choice_parse(&is, object->material, strlen(object->material));
    } else if (scene->model.object_count == 1 ||
               (scene->model.object_count && frame_media_are_from_settings(scene))) {
        const char *name = scene->model.materials[scene->model.objects[0].material].name;
        is.preset = setup_find_material(&request->settings, absorption_scale(view));
        is.finish = find_finish(request);
        if (!is.preset && !frame_media_are_from_settings(scene))
            material_choice_parse(&is, name, strlen(name)); /* files store a rounded index */
    }
    return is;
}

/* Draws the choice of a smooth, rough or frosted surface. */
static void finish_buttons(const struct ui_view *view, struct ui_request *request,
                           const struct material_choice *is)
{
    const char *names[] = { "smooth", material_finishes[0].name, material_finishes[1].name };
    uint32_t chosen = is->finish ? 1 + (uint32_t)(is->finish - material_finishes) : 0;
    if (!is->preset ||
        !ui_named_buttons("Surface", names, 3, &chosen,
                          "finish of the surface; rough ones need refraction model trace"))
        return;
    choose_material(
        view, request,
        &(struct material_choice){ is->preset, chosen ? &material_finishes[chosen - 1] : NULL });
}

/* Draws buttons for the material presets of one kind. */
static void material_buttons(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    const struct material_choice now = current_material(view, request);
    const struct material_preset *is = now.preset;
    const uint32_t *all = thumbnails_if_high(ui, view, ui->thumbnails->materials);
    const struct material_preset *shown[MATERIAL_MAX];
    const char *names[MATERIAL_MAX], *tips[MATERIAL_MAX];
    uint32_t thumbnails[MATERIAL_MAX], count = 0, chosen = UINT32_MAX;
    kind_list(ui, is);
    for (const struct material_preset *m = material_presets; m->name && count < MATERIAL_MAX; m++) {
        if (m->kind != ui->material_kind)
            continue;
        chosen = m == is ? count : chosen;
        thumbnails[count] = all ? all[m - material_presets] : UI_THUMBNAIL_NONE;
        names[count] = m->name;
        tips[count] = m->help;
        shown[count++] = m;
    }
    const struct ui_gallery gallery = {
        .name = "Material preset",
        .heading = "Material",
        .names = names,
        .tooltips = tips,
        .thumbnails = all ? thumbnails : NULL,
        .count = count,
    };
    if (ui_gallery(&gallery, &chosen))
        choose_material(view, request, &(struct material_choice){ shown[chosen], now.finish });
    finish_buttons(view, request, &now);
}

/* Draws the names of the objects that the material applies to, and the list of materials. */
static void material_group(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    char text[MATERIAL_NAME_SIZE + 64];
    const struct scene *scene = &view->viewport->scene;
    const struct scene_object *object = ui_objects_selected(view);
    const char *reason = ui_objects_why_no_material(view);
    if (ui_objects_have_own_material(view))
        snprintf(text, sizeof(text), "Material of %s", object->label);
    else if (!frame_media_are_from_settings(scene) || !scene->model.object_count)
        snprintf(text, sizeof(text), "Material of all objects; click one to choose its own");
    else
        *text = '\0';
    if (*text)
        imgui_text_wrapped(text);
    if (reason)
        imgui_text_wrapped(reason);
    imgui_disabled_begin(reason);
    material_buttons(ui, view, request);
    if (ui_objects_have_own_material(view) && !reason)
        ui_objects_material_rows(ui, view, request);
    else if (!reason)
        request->changed =
            ui_absorption_rows(ui, &request->settings, absorption_scale(view)) || request->changed;
    imgui_disabled_end();
}

/* Draws a group's lists of presets, environments and refraction models. */
static void lists(struct ui *ui, enum ui_setting_group group, const struct ui_view *view,
                  struct ui_request *request)
{
    if (group == UI_OBJECT)
        ui_objects_rows(ui, view, request);
    if (group == UI_MATERIAL)
        material_group(ui, view, request);
    if (group == UI_CAMERA)
        ui_camera_rows(ui, view, request);
    if (group == UI_LIGHT)
        ui_environment_rows(ui, view, request);
    if (group == UI_QUALITY) {
        quality_list(request);
        refraction_lists(ui, view, request);
    }
}

/* Returns why the settings of a group have no effect in a scene; NULL if they have one. */
static const char *why_disabled(enum ui_setting_group group, const struct scene *scene)
{
    if (group != UI_INSIDE)
        return NULL;
    if (!scene->model.object.index_count)
        return "No effect: the scene has no refractive object.";
    return scene->model.object_count > 1
               ? "No effect: only scenes with a single refractive object have inclusions."
               : NULL;
}

static void groups(struct ui *ui, const struct ui_view *view, const struct ui_settings *settings,
                   struct ui_request *request)
{
    for (enum ui_setting_group g = UI_OBJECT; g < UI_GROUP_COUNT; g++) {
        imgui_id_begin(ui_setting_groups_name(g));
        request->changed = ui_settings_heading(settings, g, &ui->open[g]) || request->changed;
        const char *reason = why_disabled(g, &view->viewport->scene);
        if (ui->open[g]) {
            if (reason)
                imgui_text_wrapped(reason);
            imgui_disabled_begin(reason);
            lists(ui, g, view, request);
            if (g != UI_MATERIAL || !ui_objects_have_own_material(view))
                request->changed =
                    ui_settings_group(settings, g, &ui->shows_all[g]) || request->changed;
            imgui_disabled_end();
        }
        imgui_id_end();
    }
}

static void search(struct ui *ui, const struct settings *defaults, struct ui_request *request)
{
    static const char all[] = "Reset all";
    if (ui->focus_search)
        imgui_next_focus();
    imgui_next_width(imgui_available_width() - imgui_width(all) - 6.0f * imgui_scale());
    imgui_text_field("##search", "search settings (/)", ui->filter, sizeof(ui->filter));
    imgui_same_line(0.0f);
    if (imgui_button(all)) {
        request->settings = *defaults;
        request->changed = true;
    }
    imgui_tooltip("reset all settings to the scene's values");
}

static void settings_tab(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    const struct scene *scene = &view->viewport->scene;
    const struct settings own = setup_scene_settings(&view->viewport->state.scene, scene);
    const struct settings defaults = frame_settings(&own, scene);
    const struct ui_settings settings = { &request->settings, &defaults, scene };
    search(ui, &defaults, request);
    imgui_scroll_begin("rows");
    if (*ui->filter)
        request->changed = ui_settings_matches(&settings, ui->filter) || request->changed;
    else
        groups(ui, view, &settings, request);
    imgui_scroll_end();
}

/* Shows the memory use of the render-graph plan. */
static void show_memory(const struct ui_view *view)
{
    const struct renderer *renderer = viewport_renderer(view->viewport, false);
    char text[128];
    if (renderer) {
        const struct rg_plan *plan = renderer_frame(renderer);
        snprintf(text, sizeof(text), "%.1f MiB of memory, %.1f without aliasing",
                 (double)plan->memory_used / mebi, (double)plan->memory_without_aliasing / mebi);
        imgui_text_wrapped(text);
        imgui_tooltip("device memory of the plan's images and buffers");
    }
}

static void times_tab(const struct ui *ui, const struct ui_view *view)
{
    imgui_scroll_begin("times");
    show_memory(view);
    ui_pass_times_panel("frame", &ui->frame_times);
    if (view->viewport->right_renderer)
        ui_pass_times_panel("side B", &ui->right_times);
    ui_pass_times_panel("window", &ui->window_times);
    imgui_scroll_end();
}

static void tabs(struct ui *ui)
{
    static const struct {
        const char *label, *tip;
    } rows[] = {
        [UI_SETTINGS] = { "Settings", "settings of scene and rendering" },
        [UI_TIMES] = { "Passes", "time of each pass (B)" },
        [UI_INSPECT] = { "Inspect", "layers, histogram, values below the cursor (I)" },
    };

    const float room = imgui_available_width();
    float used = 0.0f;
    for (enum ui_tab t = UI_SETTINGS; t <= UI_INSPECT; t++) {
        const float width = imgui_width(rows[t].label) + 6.0f * imgui_scale();
        const bool fits = used + width <= room + 6.0f * imgui_scale();
        if (t != UI_SETTINGS && fits)
            imgui_same_line(0.0f);
        used = fits ? used + width : width;
        if (imgui_choice_button(rows[t].label, ui->tab == t))
            ui->tab = t;
        imgui_tooltip(rows[t].tip);
    }
}

static void side_panel(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    if (ui->focus_search)
        ui->tab = UI_SETTINGS;
    tabs(ui);
    if (*ui->error)
        imgui_warning(ui->error);
    if (ui->tab == UI_SETTINGS)
        settings_tab(ui, view, request);
    else if (ui->tab == UI_TIMES)
        times_tab(ui, view);
    else
        ui_pixel_inspector_panel(ui, view, request);
    ui->focus_search = false;
}

/* Draws the shortcut list in the middle of the window. In narrow windows it has one column instead
 * of two. In low windows, its rows are closer together. If it still does not fit, it scrolls. */
static void keys_panel(struct ui *ui, const struct ui_view *view)
{
    const uint32_t count = VIEW_INPUT_COUNT - 1;
    const float scale = ui->scale;
    const float width = fminf(728.0f * scale, (float)view->size.width);
    const uint32_t columns = width < 600.0f * scale ? 1 : 2;
    const uint32_t rows = (count + columns - 1) / columns;
    const float room = (float)view->size.height - 16.0f * scale; /* without the panel's padding */
    const float line = imgui_line_height();
    const float gap = fmaxf(fminf(4.0f * scale, room / (float)rows - line), scale);
    const float height =
        fminf((float)rows * (line + gap) + 16.0f * scale, (float)view->size.height);
    const struct imgui_rect area = { ((float)view->size.width - width) / 2.0f,
                                     ((float)view->size.height - height) / 2.0f, width, height };
    imgui_panel_begin(ui->imgui, "keys", area, IMGUI_POPUP);
    imgui_gap_begin(gap);
    imgui_scroll_begin("##keys");
    const float column = imgui_available_width() / (float)columns;
    for (uint32_t i = 0; i < rows; i++) {
        for (uint32_t c = 0; c < columns && i + c * rows < count; c++) {
            const struct key_binding *binding = &key_bindings[i + c * rows + 1];
            const float x = 8.0f * scale + (float)c * column;
            if (c)
                imgui_same_line(x);
            imgui_text_in(binding->keys, ui->theme->accent);
            imgui_name(binding->keys);
            imgui_same_line(x + 132.0f * scale);
            imgui_text_elided(binding->label, column - 142.0f * scale);
        }
    }
    imgui_scroll_end();
    imgui_gap_end();
    imgui_panel_end();
}

/* Draws the name of a compared side over a lower corner of the image. */
static void name_side(struct ui *ui, const struct ui_view *view, const char *name, bool is_right)
{
    const struct present_area *p = view->image_area;
    const float width = fminf(imgui_width(name) + 8.0f * ui->scale, 0.48f * (float)p->width);
    const float height = imgui_line_height() + 10.0f * ui->scale;
    const struct imgui_rect area = {
        (float)p->x + (is_right ? (float)p->width - width : 0.0f),
        (float)(p->y + p->height) - height,
        width,
        height,
    };
    imgui_panel_begin(ui->imgui, is_right ? "right" : "left", area, IMGUI_LABEL);
    imgui_text_elided(name, imgui_available_width());
    imgui_name(name);
    imgui_panel_end();
}

static void name_sides(struct ui *ui, const struct ui_view *view)
{
    const bool flipped = view->viewport->flipped;
    if (view->side_b == VIEW_SIDE_B_NONE || !view->image_area->width)
        return;
    name_side(ui, view, flipped ? view->right : view->left, false);
    if (!flipped)
        name_side(ui, view, view->right, true);
}

void ui_panels(struct ui *ui, const struct ui_view *view, struct ui_request *request)
{
    const struct window_layout *l = view->layout;
    if (ui->focus_panel || ui->release)
        /* The focus must be set before the first widget of the panel is drawn. */
        imgui_focus_panel(ui->release ? NULL : panel);
    ui->focus_panel = ui->release = false;
    if (l->panel.extent.width) {
        imgui_panel_begin(ui->imgui, "bar", ui_rect_of(l->bar), IMGUI_DOCKED);
        ui_toolbar(view, request);
        imgui_panel_end();
        imgui_panel_begin(ui->imgui, panel, ui_rect_of(l->panel), IMGUI_DOCKED);
        side_panel(ui, view, request);
        imgui_panel_end();
        if (l->strip.extent.height) {
            imgui_panel_begin(ui->imgui, "time", ui_rect_of(l->strip), IMGUI_DOCKED);
            ui_timeline(view, request);
            imgui_panel_end();
        }
        imgui_panel_begin(ui->imgui, "status", ui_rect_of(l->status), IMGUI_DOCKED);
        ui_status(ui, view, request);
        imgui_panel_end();
    }
    ui_objects_outline(ui, view);
    name_sides(ui, view);
    ui_legend(ui, view);
    if (ui->palette_open)
        ui_command_palette(ui, view, request);
    if (ui->keys_open)
        keys_panel(ui, view);
}
