/* view_input.c: handles mouse input and dropped files, and runs the panels. */
#include <math.h>
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/tech/output/tonemap.h"
#include "src/view/orbit_camera.h"
#include "src/view/shader_reload.h"
#include "src/view/view_internal.h"

static const float drag_turn_deg = 180.0f; /* rotation of a drag over the whole window height */

static bool has_moved(const struct window_drag *drag)
{
    return drag->x != 0.0 || drag->y != 0.0;
}

/* Counts a drag once between pressing and releasing the button. */
static void count_drag(struct view *v, const struct window_drag *drag, enum view_action gesture)
{
    uint32_t *hold = &v->holds[gesture - VIEW_DRAG];
    if (!has_moved(drag) || *hold == v->hold)
        return;
    *hold = v->hold;
    ui_count_action(v->ui, gesture);
}

static void count_gestures(struct view *v, const struct window_input *input)
{
    v->hold += input->pressed;
    count_drag(v, &input->turn, VIEW_DRAG);
    count_drag(v, &input->pan, VIEW_PAN);
    count_drag(v, &input->light, VIEW_ROTATE_LIGHT);
    count_drag(v, &input->sun, VIEW_MOVE_SUN);
    if (input->wheel != 0.0)
        ui_count_action(v->ui, VIEW_WHEEL);
    if (input->doubled)
        ui_count_action(v->ui, VIEW_CENTRE);
}

/* Applies mouse input to camera and divider. */
static void drag(struct view *v, const struct window_input *input)
{
    struct camera *camera = &v->picture->camera;
    const bool moved = has_moved(&input->turn) || has_moved(&input->pan) || input->wheel != 0.0;
    if (has_moved(&input->turn))
        orbit_camera_rotate(camera, (float)-input->turn.x * drag_turn_deg,
                            (float)input->turn.y * drag_turn_deg);
    if (has_moved(&input->pan))
        orbit_camera_pan(camera, (float)-input->pan.x, (float)input->pan.y);
    if (input->wheel != 0.0)
        view_zoom(v, (float)input->wheel);
    if (input->doubled) {
        v->aims = v->changed = true;
        v->aim_x = input->at_x;
        v->aim_y = input->at_y;
    }
    if (input->slid)
        view_move_divider(v, input->divider);
    if (input->pressed || input->wheel != 0.0 || input->action_count)
        v->refine.at_once = false;
    if (input->pressed)
        v->refine.moved_at = clock_seconds(); /* delays the next sample, as a drag may follow */
    v->refine.at_once = v->refine.at_once || input->released;
    view_frame_stats_input(&v->costs, input->moved_at, input->released_at);
    v->dragged = v->dragged || has_moved(&input->turn);
    v->changed = v->changed || input->redraw || input->slid || moved;
}

static void drag_light(struct view *v, const struct window_input *input)
{
    if (has_moved(&input->light))
        view_rotate_light(v, input->light.x, input->light.y, false);
    if (has_moved(&input->sun))
        view_rotate_light(v, input->sun.x, input->sun.y, true);
}

static void open_dropped(struct view *v)
{
    char *path = window_take_dropped(&v->window);
    if (path) {
        ui_count_action(v->ui, VIEW_DROP);
        view_open(v, path);
    }
    free(path);
}

/* Switches to recompiled shaders; keeps the previous ones if no pipelines can be created. */
static void take_shaders(struct view *v)
{
    const double start = clock_seconds();
    const bool news = v->watch && shader_reload_take(v->watch);
    if (v->watch)
        ui_set_error(v->ui, shader_reload_message(v->watch));
    if (!news)
        return;
    presenter_disconnect(&v->screen);
    if (viewport_rebuild(v->picture) != STATUS_OK)
        shader_reload_revert(v->watch);
    v->changed = true;
    view_frame_stats_exclude(&v->costs, start);
}

void view_handle_input(struct view *v)
{
    const struct window_input input = window_take_input(&v->window);
    count_gestures(v, &input);
    drag(v, &input);
    drag_light(v, &input);
    for (uint32_t i = 0; i < input.action_count; i++)
        view_execute(v, input.actions[i]);
    open_dropped(v);
    take_shaders(v);
    const bool divided =
        viewport_is_split(v->picture) && !v->picture->flipped && !v->compare.differs;
    v->window.divider = divided ? v->picture->divider : -1.0;
    v->quit = v->quit || window_is_closed(&v->window);
}

/* Returns the noise scaled by the exposure, as it appears on the display. */
static double noise_of(const struct view *v)
{
    const struct tonemap_params *tone =
        settings_of(&v->picture->state.scene.settings, &tonemap_settings);
    return noise_estimate_now(&v->refine.noise) * exp2((double)tone->exposure);
}

static void use_wish(struct view *v, const struct ui_request *wish)
{
    struct view_state wanted = view_state_now(v);
    wanted.settings = wish->settings;
    wanted.refraction = wish->refraction;
    const bool other = wish->other != wanted.other || wish->split != wanted.split;
    const bool awaits = other && wish->other == VIEW_SIDE_B_FILE;
    if (other && (!awaits || v->compare.file.linear.width))
        view_compare_choose(v, &wanted, wish->other);
    if (other && wish->other == VIEW_SIDE_B_MODEL)
        wanted.split = wish->split;
    if (wish->changed || other)
        view_edit(v, &wanted, wish->gesture);
    if (awaits)
        view_compare_await(v);
    if (wish->action != VIEW_ACTION_NONE)
        view_execute(v, wish->action);
    if (wish->seeks)
        view_seek(v, wish->time);
    if (wish->open)
        view_open(v, wish->open);
    if (wish->shot.width) {
        v->shoot = v->changed = true;
        v->shoot_size = wish->shot;
    }
}

void view_run_ui(struct view *v, VkExtent2D size)
{
    if (ui_can_skip_frame(v->ui, v->now))
        return;
    struct ui_request wish;
    char left[VIEW_SIDE_SIZE];
    char right[VIEW_SIDE_SIZE];
    view_update_layout(v, size);
    view_compare_print(v, left, right);
    const struct ui_view view = {
        .picture = v->picture,
        .screen = &v->screen,
        .pace = v->costs.last,
        .now = v->now,
        .size = size,
        .paused = v->paused,
        .time = view_time(v),
        .sample_count = v->refine.shown,
        .sample_goal = v->refine.goal,
        .noise = noise_of(v),
        .seconds_left = view_progressive_seconds_left(v),
        .is_new = !v->dragged,
        .layout = &v->layout,
        .history = &v->history,
        .reloads = &v->reloads,
        .look = &v->look,
        .inspector_wanted = v->inspector_wanted,
        .place = &v->place,
        .other = v->compare.other,
        .has_stored = v->compare.has_stored,
        .left = left,
        .right = right,
        .differs = v->compare.differs,
    };
    v->costs.last = (struct ui_frame_pacing){ 0 };
    v->look.is_open = false;
    if (!ui_is_shown(v->ui))
        return;
    ui_frame(v->ui, &view, &wish);
    v->inspector_wanted = wish.look;
    v->look.is_open = wish.looks;
    use_wish(v, &wish);
    free(wish.open);
}
