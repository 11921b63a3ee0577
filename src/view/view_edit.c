/* view_edit.c: applies changes of settings and scene, with undo, presets and opening of files. */
#include <stdio.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

enum {
    TEXT_SIZE = 200,
};

struct change {
    struct view *view;
    const struct view_state *state;
};

static void assign_settings(struct setup_scene *scene, const struct view_state *state)
{
    scene->settings = state->settings;
    scene->user_settings = state->user_settings;
}

static enum status change_viewport(void *user)
{
    const struct change *change = user;
    struct view *v = change->view;
    bool remade = false;
    struct setup_scene scene = v->viewport->state.scene;
    assign_settings(&scene, change->state);
    const enum status status =
        viewport_change(&v->viewport, &scene, change->state->refraction, &remade);
    if (remade)
        presenter_disconnect(&v->presenter);
    return status;
}

static enum status rotate_panorama(void *user)
{
    const struct change *change = user;
    return viewport_rotate_panorama(change->view->viewport, change->state->env_rotate);
}

static bool is_other_side_b(const struct view *v, const struct view_state *state)
{
    const struct view_state now = view_state_now(v);
    return state->side_b != now.side_b || state->split != now.split ||
           !settings_equal(&state->right_settings, &now.right_settings);
}

/* ---- other scenes ---- */

void view_enter_scene(struct view *v, const struct view_state *before)
{
    v->scene = ++v->scene_count;
    const struct view_state now = view_state_now(v);
    if (!v->undo_stack.count)
        undo_stack_push(&v->undo_stack, before, 0);
    undo_stack_push(&v->undo_stack, &now, 0);
    undo_scenes_prune(&v->undo_scenes, &v->undo_stack);
}

static enum status return_to_scene(void *user)
{
    const struct change *change = user;
    struct view *v = change->view;
    const struct setup_image *now = &v->viewport->state;
    const struct undo_scene *to = undo_scenes_find(v->undo_scenes, change->state->scene);
    struct setup_image state = to->state;
    state.width = now->width;
    state.height = now->height;
    state.split = now->split;
    state.refraction = change->state->refraction;
    state.scene.env_rotate = change->state->env_rotate;
    assign_settings(&state.scene, change->state);
    return viewport_apply_state(&v->viewport, &state);
}

/* Reopens the scene of a state unless that scene is open already. Restores the scene's camera
 * unless only the environment differs. */
static enum status return_to(struct view *v, const struct view_state *state)
{
    struct change change = { v, state };
    const struct undo_scene *to = undo_scenes_find(v->undo_scenes, state->scene);
    if (state->scene == v->scene || !to)
        return STATUS_OK;
    const bool is_object = strcmp(to->name, v->viewport->state.scene.name) != 0;
    const struct camera camera = is_object ? to->camera : v->viewport->camera;
    enum status status = undo_scenes_add(&v->undo_scenes, v->scene, v->viewport, v->scene_change);
    presenter_disconnect(&v->presenter);
    if (status == STATUS_OK)
        status = worker_run(&v->window, return_to_scene, &change);
    if (status != STATUS_OK)
        return status;
    v->scene = state->scene;
    snprintf(v->scene_change, sizeof(v->scene_change), "%s", to->change);
    view_use_camera(v, &camera);
    return STATUS_OK;
}

/* ---- settings ---- */

bool view_apply_state(struct view *v, const struct view_state *state)
{
    const double start = clock_seconds();
    struct change change = { v, state };
    view_clear_errors(v);
    view_compare_stop(v);
    enum status status = presenter_wait(&v->presenter);
    if (status == STATUS_OK)
        status = return_to(v, state);
    if (status == STATUS_OK)
        status = worker_run(&v->window, change_viewport, &change);
    const float rotation = v->viewport->state.scene.env_rotate;
    if (status == STATUS_OK && (state->env_rotate < rotation || state->env_rotate > rotation)) {
        presenter_disconnect(&v->presenter);
        status = worker_run(&v->window, rotate_panorama, &change);
    }
    if (status == STATUS_OK && is_other_side_b(v, state))
        status = view_compare_use(v, state);
    if (status != STATUS_OK)
        view_fail(v, "nothing was changed");
    v->changed = true;
    view_show_name(v);
    view_frame_stats_exclude(&v->frame_stats, start);
    return status == STATUS_OK;
}

/* Writes to `words` what a change rebuilt and in what time. Writes "" if nothing was rebuilt. */
static void print_cost(const struct view_state *before, const struct view_state *after,
                       double seconds, char *words, size_t size)
{
    const enum setting_effect effect = settings_changed(&before->settings, &after->settings);
    const char *what = effect == SETTING_AFFECTS_SCENE           ? "scene rebuilt"
                       : effect == SETTING_AFFECTS_PLAN          ? "plan recompiled"
                       : before->refraction != after->refraction ? "other passes compiled"
                       : before->split != after->split           ? "passes compiled"
                                                                 : NULL;
    *words = '\0';
    if (what)
        snprintf(words, size, " (%s in %.0f ms)", what, seconds * 1e3);
}

/* Marks changed settings of `state` as set by the user. If a changed setting has the scene's value
 * and was not an option of the user at start, it follows the scene again. */
static void update_sources(const struct view *v, struct view_state *state,
                           const struct settings *before)
{
    const struct settings *given = &v->options->image->scene.settings;
    const struct settings own = view_scene_settings(v);
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(&state->settings, row);
        const double old = settings_get(before, row);
        const double scene_value = settings_get(&own, row);
        if (!(value < old || value > old))
            continue;
        if (value < scene_value || value > scene_value ||
            settings_source(given, row) == SETTING_USER) {
            settings_put(&state->settings, row, value, SETTING_USER);
            settings_put(&state->user_settings, row, value, SETTING_USER);
        } else {
            settings_copy(&state->settings, row, &own);
            settings_copy(&state->user_settings, row, given);
        }
    }
}

bool view_edit(struct view *v, const struct view_state *requested, uint32_t gesture)
{
    char name[TEXT_SIZE / 2];
    char cost[TEXT_SIZE / 2];
    char words[TEXT_SIZE];
    const double start = clock_seconds();
    const struct view_state before = view_state_now(v);
    struct view_state state = *requested;
    if (!v->undo_stack.count)
        undo_stack_push(&v->undo_stack, &before, 0);
    update_sources(v, &state, &before.settings);
    if (!view_apply_state(v, &state))
        return false;
    const struct view_state now = view_state_now(v);
    undo_stack_push(&v->undo_stack, &now, gesture);
    const struct view_state *since =
        v->undo_stack.at ? &v->undo_stack.states[v->undo_stack.at - 1] : &before;
    undo_stack_describe(since, &now, name, sizeof(name)); /* describes the whole gesture */
    print_cost(&before, &now, clock_seconds() - start, cost, sizeof(cost));
    snprintf(words, sizeof(words), "%s%s", name, cost);
    ui_show_message(v->ui, words);
    return true;
}

void view_undo_redo(struct view *v, bool again)
{
    char name[TEXT_SIZE / 2];
    char cost[TEXT_SIZE / 2];
    char words[2 * TEXT_SIZE];
    char change[TEXT_SIZE / 2];
    const double start = clock_seconds();
    const struct view_state before = view_state_now(v);
    const struct view_state *to =
        again ? undo_stack_redo(&v->undo_stack) : undo_stack_undo(&v->undo_stack);
    if (!to) {
        ui_show_message(v->ui, again ? "nothing to redo" : "nothing to undo");
        return;
    }
    undo_stack_describe(&before, to, name, sizeof(name));
    snprintf(change, sizeof(change), "%s", v->scene_change);
    if (!view_apply_state(v, to)) {
        (void)(again ? undo_stack_undo(&v->undo_stack) : undo_stack_redo(&v->undo_stack));
        return;
    }
    const char *scene_change = again ? v->scene_change : change;
    if (to->scene != before.scene && *scene_change)
        snprintf(name, sizeof(name), "%s", scene_change);
    else if (to->scene != before.scene)
        snprintf(name, sizeof(name), "back to %s", v->viewport->state.scene.name);
    print_cost(&before, to, clock_seconds() - start, cost, sizeof(cost));
    snprintf(words, sizeof(words), "%s: %s%s", again ? "redo" : "undo", name, cost);
    ui_show_message(v->ui, words);
}
