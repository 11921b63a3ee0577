/* view_mouse_input.c: handles mouse input and dropped files, and runs the panels. */
#include <math.h>
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/view/orbit_camera.h"
#include "src/view/shader_reload.h"
#include "src/view/view_internal.h"

static const float drag_rotation_deg = 180.0f; /* degrees per drag over the whole window height */

static bool has_moved(const struct window_drag *drag)
{
    return drag->x != 0.0 || drag->y != 0.0;
}

/* Applies mouse input to camera and divider. */
static void drag(struct view *v, const struct window_input *input)
{
    struct camera *camera = &v->viewport->camera;
    const bool moved = has_moved(&input->orbit) || has_moved(&input->pan) || input->wheel != 0.0;
    if (has_moved(&input->orbit))
        orbit_camera_rotate(camera, (float)-input->orbit.x * drag_rotation_deg,
                            (float)input->orbit.y * drag_rotation_deg);
    if (has_moved(&input->pan))
        orbit_camera_pan(camera, (float)-input->pan.x, (float)input->pan.y);
    if (input->wheel != 0.0)
        view_zoom(v, (float)input->wheel);
    if (input->double_clicked) {
        v->recenters = v->changed = true;
        v->recenter_x = input->click_x;
        v->recenter_y = input->click_y;
    }
    if (input->moved_divider)
        view_move_divider(v, input->divider);
    if (input->pressed || input->wheel != 0.0 || input->action_count)
        v->progressive.skips_rest = false;
    /* a press postpones the next sample like a camera movement does, because a drag may follow */
    if (input->pressed)
        v->progressive.moved_at = clock_seconds();
    v->progressive.skips_rest = v->progressive.skips_rest || input->released;
    view_frame_stats_input(&v->frame_stats, input->moved_at, input->released_at);
    v->has_orbited = v->has_orbited || has_moved(&input->orbit);
    v->changed = v->changed || input->redraw || input->moved_divider || moved;
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
    if (path)
        view_open(v, path);
    free(path);
}

/* Switches to recompiled shaders. If pipelines cannot be created, keeps the previous shaders. */
static void take_shaders(struct view *v)
{
    const double start = clock_seconds();
    const bool has_new = v->shader_reload && shader_reload_take(v->shader_reload);
    if (v->shader_reload)
        ui_set_error(v->ui, shader_reload_message(v->shader_reload));
    if (!has_new)
        return;
    presenter_disconnect(&v->presenter);
    if (viewport_rebuild(v->viewport) != STATUS_OK)
        shader_reload_revert(v->shader_reload);
    v->changed = true;
    view_frame_stats_exclude(&v->frame_stats, start);
}

void view_handle_input(struct view *v)
{
    const struct window_input input = window_take_input(&v->window);
    v->press_count += input.pressed;
    drag(v, &input);
    drag_light(v, &input);
    for (uint32_t i = 0; i < input.action_count; i++)
        view_execute(v, input.actions[i]);
    open_dropped(v);
    take_shaders(v);
    const bool divided =
        viewport_is_split(v->viewport) && !v->viewport->flipped && !v->compare.wants_error_map;
    v->window.divider = divided ? v->viewport->divider : -1.0;
    v->quit = v->quit || window_is_closed(&v->window);
}

/* Loads the scene with the exposure of the environment and the ground that were chosen. */
static void reload(struct view *v, const struct ui_request *request)
{
    char words[96];
    struct setup_scene scene = v->viewport->state.scene;
    if (request->ground != scene.ground.ground) {
        scene.exposure.is_chosen = false;
        snprintf(words, sizeof(words), "--ground %s", stage_ground_names[request->ground]);
    } else {
        snprintf(words, sizeof(words), "--env-exposure %.3g", (double)request->env_exposure);
    }
    scene.ground.ground = request->ground;
    scene.env_exposure = request->env_exposure;
    view_reload_scene(v, &scene, words);
}

/* Applies requests of the panels for objects, materials, ground and environment. */
static void use_object_request(struct view *v, const struct ui_request *request)
{
    if (request->selects)
        view_select(v, request->selected);
    if (request->focuses)
        view_focus(v, request->pick_x, request->pick_y);
    if (request->picks)
        view_pick(v, request->pick_x, request->pick_y);
    if (request->overrides)
        view_override_material(v, &request->override);
    if (request->transforms)
        view_transform_object(v, &request->transform);
    if (request->reloads)
        reload(v, request);
}

static void use_request(struct view *v, const struct ui_request *request)
{
    struct view_state requested = view_state_now(v);
    requested.settings = request->settings;
    requested.refraction = request->refraction;
    const bool other = request->side_b != requested.side_b || request->split != requested.split;
    const bool awaits = other && request->side_b == VIEW_SIDE_B_FILE;
    if (other && (!awaits || v->compare.file.linear.width))
        view_compare_choose(v, &requested, request->side_b);
    if (other && request->side_b == VIEW_SIDE_B_MODEL)
        requested.split = request->split;
    if (request->rotates)
        requested.env_rotate = request->env_rotate;
    if (request->changed || other || request->rotates)
        view_edit(v, &requested, request->gesture);
    if (awaits)
        view_compare_await(v);
    if (request->action != VIEW_ACTION_NONE)
        view_execute(v, request->action);
    if (request->fov_deg > 0.0f) {
        v->viewport->camera.fov_deg = request->fov_deg;
        v->changed = true;
    }
    if (request->seeks)
        view_seek(v, request->time);
    if (request->open)
        view_open(v, request->open);
    if (request->material.preset)
        view_replace_materials(v, &request->material);
    use_object_request(v, request);
    if (request->screenshot_size.width) {
        v->wants_screenshot = v->changed = true;
        v->screenshot_size = request->screenshot_size;
    }
}

void view_run_ui(struct view *v, VkExtent2D size)
{
    if (ui_can_skip_frame(v->ui, v->now))
        return;
    struct ui_request request;
    char left[VIEW_SIDE_SIZE];
    char right[VIEW_SIDE_SIZE];
    view_update_layout(v, size);
    view_compare_print(v, left, right);
    view_update_objects(v);
    const struct ui_view view = {
        .bookmark = view_bookmark(v),
        .objects = &v->objects,
        .selected = v->selected,
        .outline = &v->outline,
        .viewport = v->viewport,
        .presenter = &v->presenter,
        .pace = v->frame_stats.last,
        .now = v->now,
        .size = size,
        .paused = v->paused,
        .time = view_time(v),
        .sample_count = v->progressive.shown_count,
        .sample_goal = v->progressive.target_count,
        .sample_seconds = v->progressive.sample_seconds,
        .is_first_sample = view_progressive_is_first(v),
        .is_stopped = v->progressive.is_stopped,
        .seconds_left = view_progressive_seconds_left(v),
        .shows_hint = !v->has_orbited,
        .layout = &v->layout,
        .undo_stack = &v->undo_stack,
        .inspector = &v->inspector,
        .inspector_choice = v->inspector_choice,
        .image_area = &v->image_area,
        .side_b = v->compare.side_b,
        .has_stored = v->compare.has_stored,
        .left = left,
        .right = right,
        .shows_error_map = v->compare.wants_error_map,
        .error_map =
            v->compare.wants_error_map && v->compare.has_error_image && !v->compare.flip_map.runs
                ? &v->compare.flip_map
                : NULL,
    };
    v->frame_stats.last = (struct ui_frame_pacing){ 0 };
    v->inspector.is_open = false;
    if (!ui_is_shown(v->ui))
        return;
    ui_frame(v->ui, &view, &request);
    v->inspector_choice = request.inspector_choice;
    v->inspector.is_open = request.inspects;
    use_request(v, &request);
    free(request.open);
}
