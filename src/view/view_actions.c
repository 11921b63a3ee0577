/* view_actions.c: executes the actions of keys, buttons and the command palette. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "src/settings/scene_settings.h"
#include "src/view/orbit_camera.h"
#include "src/view/panels/ui_reproduce_command.h"
#include "src/view/session/xdg_folders.h"
#include "src/view/view_internal.h"

static const float key_rotation_deg = 5.0f;
static const float ui_scale_step = 0.25f;
static const double key_stops = 0.5;
static const double key_slide = 1.0 / 32; /* fraction of the image width */

void view_zoom(struct view *v, float steps)
{
    float nearest;
    float farthest;
    viewport_camera_range(v->viewport, &nearest, &farthest);
    orbit_camera_zoom(&v->viewport->camera, steps, nearest, farthest);
}

static void copy_command(struct view *v)
{
    char *text = ui_render_command_print(&(struct ui_render_command){
        .image = &v->viewport->state,
        .scene = &v->viewport->scene,
        .camera = &v->viewport->camera,
        .time = v->drawn_time,
    });
    if (!text)
        return;
    window_copy(&v->window, text);
    printf("%s\n", text);
    fflush(stdout);
    ui_show_message(v->ui, "command copied to the clipboard");
    free(text);
}

static void open_panel(struct view *v, enum view_action action)
{
    const bool helps = ui_toggle(v->ui, action) && action == VIEW_HELP;
    if (helps) {
        key_bindings_print(stdout);
        fflush(stdout);
    }
    if (!ui_is_shown(v->ui))
        view_show_ui(v, true);
}

/* Rescales text and panels; hidden panels stay hidden. */
static void resize_ui(struct view *v, float scale)
{
    const bool shown = ui_is_shown(v->ui);
    v->ui_scale = fminf(fmaxf(scale, SETUP_UI_SCALE_MIN), SETUP_UI_SCALE_MAX);
    presenter_set_font(&v->presenter, NULL);
    if (ui_rescale(v->ui, v->ui_scale) == STATUS_OK)
        view_show_ui(v, shown);
    else
        v->quit = true; /* the error has been logged */
}

static float default_scale(const struct view *v)
{
    const float given = v->options->window->ui_scale;
    return given > 0.0f ? given : window_scale(&v->window);
}

void view_move_divider(struct view *v, double to)
{
    v->viewport->divider = to < 0.0 ? 0.0 : to > 1.0 ? 1.0 : to;
}

static void change_projection(struct view *v)
{
    struct camera camera = v->viewport->camera;
    float nearest;
    float farthest;
    viewport_camera_range(v->viewport, &nearest, &farthest);
    orbit_camera_toggle_projection(&camera, 4.0f * farthest);
    view_use_camera(v, &camera);
}

uint32_t view_bookmark(const struct view *v)
{
    const uint32_t count =
        v->bookmark_count < VIEW_BOOKMARK_COUNT ? v->bookmark_count : VIEW_BOOKMARK_COUNT;
    for (uint32_t i = 0; i < count; i++) {
        if (camera_is_equal(&v->bookmarks[i], &v->viewport->camera))
            return i;
    }
    return UINT32_MAX;
}

/* Stores the camera or returns to a stored one. Returns false for other actions. */
static bool use_bookmark(struct view *v, enum view_action action)
{
    char words[64];
    const uint32_t i = v->bookmark_count % VIEW_BOOKMARK_COUNT;
    if (action == VIEW_ADD_BOOKMARK) {
        v->bookmarks[i] = v->viewport->camera;
        v->bookmark_count++;
        snprintf(words, sizeof(words), "camera stored as bookmark %u: Ctrl %u returns to it", i + 1,
                 i + 1);
        ui_show_message(v->ui, words);
        return true;
    }
    if (action < VIEW_BOOKMARK_1 || action > VIEW_BOOKMARK_4)
        return false;
    const uint32_t asked = (uint32_t)(action - VIEW_BOOKMARK_1);
    if (asked < v->bookmark_count)
        view_use_camera(v, &v->bookmarks[asked]);
    else
        ui_show_message(v->ui, "no camera is stored there: Ctrl B stores one");
    return true;
}

/* Handles view directions and projection. Returns false for other actions. */
static bool set_camera(struct view *v, enum view_action action)
{
    struct camera *camera = &v->viewport->camera;
    if (action == VIEW_FRONT)
        orbit_camera_look_from(camera, 0.0f, 0.0f);
    else if (action == VIEW_SIDE)
        orbit_camera_look_from(camera, 90.0f, 0.0f);
    else if (action == VIEW_TOP)
        orbit_camera_look_from(camera, 0.0f, 90.0f);
    else if (action == VIEW_ORTHOGRAPHIC)
        change_projection(v);
    else
        return false;
    return true;
}

/* Handles orbiting, zooming and resetting the camera. Returns true if `action` is one of these. */
static bool move_camera(struct view *v, enum view_action action)
{
    struct camera *camera = &v->viewport->camera;
    if (action == VIEW_LEFT || action == VIEW_RIGHT)
        orbit_camera_rotate(camera, action == VIEW_RIGHT ? key_rotation_deg : -key_rotation_deg,
                            0.0f);
    else if (action == VIEW_UP || action == VIEW_DOWN)
        orbit_camera_rotate(camera, 0.0f, action == VIEW_UP ? key_rotation_deg : -key_rotation_deg);
    else if (action == VIEW_ZOOM_IN || action == VIEW_ZOOM_OUT)
        view_zoom(v, action == VIEW_ZOOM_IN ? 1.0f : -1.0f);
    else if (action == VIEW_RESET)
        view_use_camera(v, &v->viewport->first_camera);
    else
        return false;
    return true;
}

static void set_theme(struct view *v, uint32_t theme)
{
    v->theme = theme_at(theme) ? theme : 0;
    ui_set_theme(v->ui, theme_at(v->theme));
    window_set_background(&v->window, theme_at(v->theme)->surround);
}

/* Handles actions that concern the window or its panels. Returns false for other actions. */
static bool change_window(struct view *v, enum view_action action)
{
    if (action == VIEW_FULLSCREEN)
        window_toggle_fullscreen(&v->window);
    else if (action == VIEW_HIDE)
        view_show_ui(v, !ui_is_shown(v->ui));
    else if (action == VIEW_HELP || action == VIEW_TIMES || action == VIEW_PALETTE ||
             action == VIEW_INSPECT)
        open_panel(v, action);
    else if (action == VIEW_LARGER || action == VIEW_SMALLER)
        resize_ui(v, v->ui_scale + (action == VIEW_LARGER ? ui_scale_step : -ui_scale_step));
    else if (action == VIEW_RESET_SIZE)
        resize_ui(v, default_scale(v));
    else if (action == VIEW_THEME)
        set_theme(v, v->theme + 1);
    else if (action == VIEW_QUIT)
        v->quit = true;
    else
        return false;
    return true;
}

static void open_next(struct view *v, int step)
{
    char *path = user_files_next_model(v->viewport->state.scene.name, step);
    if (path)
        view_open(v, path);
    else
        ui_show_message(v->ui, "no other model in this folder");
    free(path);
}

static void step_layer(struct view *v, int step)
{
    char text[256];
    uint32_t count = 1;
    while (pixel_inspector_layer(count))
        count++;
    v->inspector_choice.layer = (v->inspector_choice.layer + count + (uint32_t)step) % count;
    v->inspector_choice.channel = 0;
    const struct frame_layer *layer = pixel_inspector_layer(v->inspector_choice.layer);
    snprintf(text, sizeof(text), "%s: %s", layer ? layer->name : "image",
             layer ? layer->help : "unmodified");
    ui_show_message(v->ui, text);
}

static void step_time(struct view *v, float frames)
{
    char text[32];
    const struct motion_params *motion =
        settings_of(&v->viewport->state.scene.settings, &motion_settings);
    view_seek(v, view_time(v) + frames / motion->fps);
    snprintf(text, sizeof(text), "time %.4g s", (double)view_time(v));
    ui_show_message(v->ui, text);
}

/* Handles saving and copying. Returns true if `action` is one of these. */
static bool save(struct view *v, enum view_action action)
{
    if (action == VIEW_SCREENSHOT)
        v->wants_screenshot = true;
    else if (action == VIEW_COPY_IMAGE)
        v->wants_screenshot = v->screenshot_to_clipboard = true;
    else if (action == VIEW_COPY)
        copy_command(v);
    else if (action == VIEW_SAVE_SESSION)
        view_save_session(v);
    else if (action == VIEW_SAVE_PRESET)
        view_save_preset(v);
    else
        return false;
    return true;
}

/* Handles next and previous frame, file and layer. Returns true if `action` is one of these. */
static bool step(struct view *v, enum view_action action)
{
    if (action == VIEW_NEXT_FRAME || action == VIEW_PREVIOUS_FRAME)
        step_time(v, action == VIEW_NEXT_FRAME ? 1.0f : -1.0f);
    else if (action == VIEW_NEXT_FILE || action == VIEW_PREVIOUS_FILE)
        open_next(v, action == VIEW_NEXT_FILE ? 1 : -1);
    else if (action == VIEW_NEXT_LAYER || action == VIEW_PREVIOUS_LAYER)
        step_layer(v, action == VIEW_NEXT_LAYER ? 1 : -1);
    else
        return false;
    return true;
}

static void change_viewport(struct view *v, enum view_action action)
{
    if (save(v, action) || step(v, action))
        return;
    if (action == VIEW_PAUSE) {
        v->paused = !v->paused;
        view_show_name(v);
    } else if (action == VIEW_DIVIDER_LEFT || action == VIEW_DIVIDER_RIGHT) {
        const double by = action == VIEW_DIVIDER_LEFT ? -key_slide : key_slide;
        view_move_divider(v, v->viewport->divider + by);
    } else if (action == VIEW_BRIGHTER || action == VIEW_DARKER) {
        view_add_exposure(v, action == VIEW_BRIGHTER ? key_stops : -key_stops);
    } else if (action == VIEW_UNDO || action == VIEW_REDO) {
        view_undo_redo(v, action == VIEW_REDO);
    } else if (action == VIEW_DRAFT) {
        struct draft_renderer *draft = &v->viewport->draft;
        draft->is_off = !draft->is_off;
        ui_show_message(v->ui, draft->is_off
                                   ? "full size and quality while something moves"
                                   : "fast drafts at lower resolution while something moves");
    } else if (action == VIEW_STOP) {
        view_progressive_stop(v);
    } else if (action == VIEW_FALSE_COLORS) {
        v->inspector_choice.false_color = !v->inspector_choice.false_color;
    }
}

/* Handles the actions of the A/B comparison. Returns true if `action` is one of these. */
static bool compare(struct view *v, enum view_action action)
{
    if (action == VIEW_SPLIT)
        view_compare_toggle(v);
    else if (action == VIEW_REFERENCE)
        view_compare_with(v, VIEW_SIDE_B_REFERENCE);
    else if (action == VIEW_STORE)
        view_compare_store(v);
    else if (action == VIEW_FLIP)
        view_compare_flip(v);
    else if (action == VIEW_ERROR_MAP)
        view_compare_toggle_error_map(v);
    else
        return false;
    return true;
}

void view_execute(struct view *v, enum view_action action)
{
    v->changed = true;
    if (!compare(v, action) && !use_bookmark(v, action) && !move_camera(v, action) &&
        !set_camera(v, action) && !change_window(v, action))
        change_viewport(v, action);
}
