/* view_input.c: keys, drags, drops, panels. */
#include <math.h>
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/view/orbit.h"
#include "src/view/ui/ui_command.h"
#include "src/view/view_internal.h"
#include "src/view/watch.h"
#include "src/view/worker.h"

static const float key_turn_deg = 5.0f;
static const float drag_turn_deg = 180.0f; /* over the window's height */
static const float ui_scale_step = 0.25f;
static const double key_slide = 1.0 / 32; /* of the window's width */

/* ---- actions ---- */

static void zoom(struct view *v, float steps)
{
    float nearest;
    float farthest;
    picture_range(v->picture, &nearest, &farthest);
    orbit_zoom(&v->picture->camera, steps, nearest, farthest);
}

/* --split, or the last rung, which is the most exact one; beside it the first. */
static const struct technique *other_rung(const struct view *v)
{
    const struct technique *last = NULL, *next;
    if (v->options->picture.split)
        return v->options->picture.split;
    for (size_t i = 0; (next = techniques_rung(i)); i++)
        last = next;
    return v->picture->state.rung == last ? techniques_rung(0) : last;
}

/* A failure has been logged; it stays as it was. NULL: not split. */
static void split(struct view *v, const struct technique *rung)
{
    const double start = clock_seconds();
    screen_disconnect(&v->screen);
    (void)!picture_split(v->picture, rung);
    v->changed = true;
    view_show_name(v);
    view_costs_rest(&v->costs, start);
}

static void copy_command(struct view *v)
{
    char *words = ui_command_print(&(struct ui_command){
        .picture = &v->picture->state,
        .scene = &v->picture->scene,
        .camera = &v->picture->camera,
        .time = v->shown,
    });
    if (!words)
        return;
    window_copy(&v->window, words);
    printf("%s\n", words);
    fflush(stdout);
    ui_say(v->ui, "copied the command to the clipboard");
    free(words);
}

static void open_panel(struct view *v, enum view_action action)
{
    if (action == VIEW_HELP) {
        keys_print(stdout);
        fflush(stdout);
    }
    ui_toggle(v->ui, action);
    if (!ui_is_shown(v->ui))
        view_show_ui(v, true);
}

/* Of text and panels; what is shown stays so. */
static void resize_ui(struct view *v, float scale)
{
    const bool shown = ui_is_shown(v->ui);
    v->ui_scale = fminf(fmaxf(scale, APP_UI_SCALE_MIN), APP_UI_SCALE_MAX);
    screen_lay_over(&v->screen, NULL);
    if (ui_rescale(v->ui, v->ui_scale) == STATUS_OK)
        view_show_ui(v, shown);
    else
        v->quit = true; /* has been logged */
}

static float usual_scale(const struct view *v)
{
    const float given = v->options->view.ui_scale;
    return given > 0.0f ? given : window_scale(&v->window);
}

static void slide(struct view *v, double to)
{
    v->picture->divider = to < 0.0 ? 0.0 : to > 1.0 ? 1.0 : to;
}

/* Whether that is what the action does. */
static bool move_camera(struct view *v, enum view_action action)
{
    struct camera *camera = &v->picture->camera;
    if (action == VIEW_LEFT || action == VIEW_RIGHT)
        orbit_turn(camera, action == VIEW_RIGHT ? key_turn_deg : -key_turn_deg, 0.0f);
    else if (action == VIEW_UP || action == VIEW_DOWN)
        orbit_turn(camera, 0.0f, action == VIEW_UP ? key_turn_deg : -key_turn_deg);
    else if (action == VIEW_NEARER || action == VIEW_FARTHER)
        zoom(v, action == VIEW_NEARER ? 1.0f : -1.0f);
    else if (action == VIEW_RESET)
        *camera = v->picture->first_camera;
    else
        return false;
    return true;
}

static void act(struct view *v, enum view_action action)
{
    v->changed = true;
    if (move_camera(v, action))
        return;
    switch (action) {
    case VIEW_PAUSE:
        v->paused = !v->paused;
        view_show_name(v);
        break;
    case VIEW_SCREENSHOT:
        v->shoot = true;
        break;
    case VIEW_FULLSCREEN:
        window_fill_screen(&v->window);
        break;
    case VIEW_SPLIT:
        split(v, v->picture->state.split ? NULL : other_rung(v));
        break;
    case VIEW_DIVIDER_LEFT:
        slide(v, v->picture->divider - key_slide);
        break;
    case VIEW_DIVIDER_RIGHT:
        slide(v, v->picture->divider + key_slide);
        break;
    case VIEW_SHOT_OF_ALL:
        v->shoot = v->shoot_all = true;
        break;
    case VIEW_HIDE:
        view_show_ui(v, !ui_is_shown(v->ui));
        break;
    case VIEW_HELP:
    case VIEW_TIMES:
    case VIEW_PLAN:
        open_panel(v, action);
        break;
    case VIEW_COPY:
        copy_command(v);
        break;
    case VIEW_LARGER:
    case VIEW_SMALLER:
        resize_ui(v, v->ui_scale + (action == VIEW_LARGER ? ui_scale_step : -ui_scale_step));
        break;
    case VIEW_USUAL_SIZE:
        resize_ui(v, usual_scale(v));
        break;
    case VIEW_QUIT:
        v->quit = true;
        break;
    case VIEW_LEFT:
    case VIEW_RIGHT:
    case VIEW_UP:
    case VIEW_DOWN:
    case VIEW_NEARER:
    case VIEW_FARTHER:
    case VIEW_RESET:
    case VIEW_NOTHING:
    case VIEW_ACTION_COUNT:
        break;
    }
}

/* ---- events ---- */

/* The picture follows the hand. */
static void drag(struct view *v, const struct window_input *input)
{
    struct camera *camera = &v->picture->camera;
    if (input->turn_x != 0.0 || input->turn_y != 0.0)
        orbit_turn(camera, (float)-input->turn_x * drag_turn_deg,
                   (float)input->turn_y * drag_turn_deg);
    if (input->pan_x != 0.0 || input->pan_y != 0.0)
        orbit_pan(camera, (float)-input->pan_x, (float)input->pan_y);
    if (input->wheel != 0.0)
        zoom(v, (float)input->wheel);
    if (input->slid)
        slide(v, input->divider);
    v->changed = v->changed || input->redraw || input->slid || input->turn_x != 0.0 ||
                 input->turn_y != 0.0 || input->pan_x != 0.0 || input->pan_y != 0.0 ||
                 input->wheel != 0.0;
}

struct drop {
    struct view *view;
    char *path;
};

static enum status open_file(void *user)
{
    const struct drop *drop = user;
    bool remade;
    return picture_open(&drop->view->picture, drop->path, &remade);
}

/* A file that cannot be used has been logged; what was there stays. */
static void open_dropped(struct view *v)
{
    struct drop drop = { .view = v, .path = window_take_dropped(&v->window) };
    const double start = clock_seconds();
    if (!drop.path)
        return;
    view_say(v, "loading");
    screen_disconnect(&v->screen);
    (void)!worker_run(&v->window, open_file, &drop);
    free(drop.path);
    v->changed = true;
    view_show_name(v);
    view_costs_rest(&v->costs, start);
}

/* Shaders that were saved count from now on; if they cannot, those before stay. */
static void take_shaders(struct view *v)
{
    const double start = clock_seconds();
    const bool news = v->watch && watch_take(v->watch);
    if (v->watch)
        ui_complain(v->ui, watch_message(v->watch));
    if (!news)
        return;
    screen_disconnect(&v->screen);
    if (picture_remake(v->picture) != STATUS_OK)
        watch_revert(v->watch);
    v->changed = true;
    view_costs_rest(&v->costs, start);
}

void view_handle(struct view *v)
{
    const struct window_input input = window_take(&v->window);
    drag(v, &input);
    for (uint32_t i = 0; i < input.action_count; i++)
        act(v, input.actions[i]);
    open_dropped(v);
    take_shaders(v);
    v->window.divider = v->picture->state.split ? v->picture->divider : -1.0;
    v->quit = v->quit || window_is_closed(&v->window);
}

/* ---- panels ---- */

struct change {
    struct view *view;
    const struct ui_wish *wish;
};

static enum status change_picture(void *user)
{
    const struct change *change = user;
    struct view *v = change->view;
    bool remade = false;
    const enum status status =
        picture_change(&v->picture, &change->wish->settings, change->wish->rung, &remade);
    if (remade)
        screen_disconnect(&v->screen);
    return status;
}

/* What cannot be has been logged; what was there stays. */
static void change(struct view *v, const struct ui_wish *wish)
{
    const double start = clock_seconds();
    struct change change = { v, wish };
    if (screen_wait(&v->screen) != STATUS_OK ||
        worker_run(&v->window, change_picture, &change) != STATUS_OK)
        ui_say(v->ui, "the change failed: see the terminal");
    v->changed = true;
    view_show_name(v);
    view_costs_rest(&v->costs, start);
}

void view_run_ui(struct view *v, VkExtent2D size)
{
    struct ui_wish wish;
    const struct ui_view view = {
        .picture = v->picture,
        .screen = &v->screen,
        .pace = v->costs.last,
        .now = v->now,
        .size = size,
        .paused = v->paused,
    };
    v->costs.last = (struct ui_pace){ 0 };
    if (!ui_is_shown(v->ui))
        return;
    ui_frame(v->ui, &view, &wish);
    if (wish.changed)
        change(v, &wish);
    if (wish.split != v->picture->state.split)
        split(v, wish.split);
    if (wish.action != VIEW_NOTHING)
        act(v, wish.action);
}
