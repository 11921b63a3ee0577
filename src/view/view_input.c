/* view_input.c: drags, drops, panels. */
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/view/orbit.h"
#include "src/view/view_internal.h"
#include "src/view/watch.h"

static const float drag_turn_deg = 180.0f; /* over the window's height */

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
        view_zoom(v, (float)input->wheel);
    if (input->doubled) {
        v->aims = v->changed = true;
        v->aim_x = input->at_x;
        v->aim_y = input->at_y;
    }
    if (input->slid)
        view_slide(v, input->divider);
    if (input->pressed || input->wheel != 0.0 || input->action_count)
        v->refine.at_once = false;
    v->refine.at_once = v->refine.at_once || input->released;
    view_costs_hand(&v->costs, input->moved_at, input->released_at);
    v->dragged = v->dragged || input->turn_x != 0.0 || input->turn_y != 0.0;
    v->changed = v->changed || input->redraw || input->slid || input->turn_x != 0.0 ||
                 input->turn_y != 0.0 || input->pan_x != 0.0 || input->pan_y != 0.0 ||
                 input->wheel != 0.0;
}

static void open_dropped(struct view *v)
{
    char *path = window_take_dropped(&v->window);
    if (path)
        view_open(v, path);
    free(path);
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
        view_act(v, input.actions[i]);
    open_dropped(v);
    take_shaders(v);
    v->window.divider = v->picture->state.split ? v->picture->divider : -1.0;
    v->quit = v->quit || window_is_closed(&v->window);
}

/* ---- panels ---- */

void view_run_ui(struct view *v, VkExtent2D size)
{
    struct ui_wish wish;
    view_lay_out(v, size);
    const struct ui_view view = {
        .picture = v->picture,
        .screen = &v->screen,
        .pace = v->costs.last,
        .now = v->now,
        .size = size,
        .paused = v->paused,
        .sample_count = v->refine.shown,
        .sample_goal = v->refine.goal,
        .is_new = !v->dragged,
        .layout = &v->layout,
        .history = &v->history,
        .look = &v->look,
        .look_wanted = v->look_wanted,
        .place = &v->place,
    };
    v->costs.last = (struct ui_pace){ 0 };
    v->look.is_open = false;
    if (!ui_is_shown(v->ui))
        return;
    ui_frame(v->ui, &view, &wish);
    v->look_wanted = wish.look;
    v->look.is_open = wish.looks;
    const struct view_state wanted = { wish.settings, wish.rung, wish.split };
    if (wish.changed || wish.split != v->picture->state.split)
        view_change(v, &wanted, wish.gesture);
    if (wish.action != VIEW_NOTHING)
        view_act(v, wish.action);
    if (wish.open)
        view_open(v, wish.open);
    if (wish.shot.width) {
        v->shoot = v->changed = true;
        v->shoot_size = wish.shot;
    }
    free(wish.open);
}
