/* view_edit.c: applies changes of settings and scene, with undo, presets and opening of files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/render/frame/pass_list.h"
#include "src/setup/apply_preset.h"
#include "src/view/session/file_kind.h"
#include "src/view/session/recent_files.h"
#include "src/view/session/xdg_folders.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

enum {
    TEXT_SIZE = 200,
};

struct view_state view_state_now(const struct view *v)
{
    const struct setup_image *p = &v->viewport->state;
    struct view_state state = {
        .scene = v->scene,
        .settings = frame_settings(&p->scene.settings, &v->viewport->scene),
        .user_settings = p->scene.user_settings,
        .refraction = p->refraction,
        .side_b = v->compare.side_b,
        .split = p->split,
        .env_rotate = p->scene.env_rotate,
    };
    if (v->viewport->has_right_settings)
        state.right_settings = v->viewport->right_settings;
    return state;
}

struct settings view_scene_settings(const struct view *v)
{
    const struct setup_scene *given = &v->options->image->scene;
    struct setup_scene own = v->viewport->state.scene;
    own.settings = given->settings;
    setup_apply_scene_settings(&own, &v->viewport->scene);
    return frame_settings(&own.settings, &v->viewport->scene);
}

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
    enum status status = undo_scenes_add(&v->undo_scenes, v->scene, v->viewport);
    presenter_disconnect(&v->presenter);
    if (status == STATUS_OK)
        status = worker_run(&v->window, return_to_scene, &change);
    if (status != STATUS_OK)
        return status;
    v->scene = state->scene;
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
        status = viewport_rotate_panorama(v->viewport, state->env_rotate);
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

/* Finds out which of the settings that differ from `before` the user has set: those that do not
 * have the scene's value. The others keep following the scene. */
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
    if (*cost)
        rebuild_log_add(&v->rebuild_log, words);
    ui_show_message(v->ui, words);
    return true;
}

void view_undo_redo(struct view *v, bool again)
{
    char name[TEXT_SIZE / 2];
    char cost[TEXT_SIZE / 2];
    char words[2 * TEXT_SIZE];
    const double start = clock_seconds();
    const struct view_state before = view_state_now(v);
    const struct view_state *to =
        again ? undo_stack_redo(&v->undo_stack) : undo_stack_undo(&v->undo_stack);
    if (!to) {
        ui_show_message(v->ui, again ? "nothing to redo" : "nothing to undo");
        return;
    }
    undo_stack_describe(&before, to, name, sizeof(name));
    if (!view_apply_state(v, to)) {
        (void)(again ? undo_stack_undo(&v->undo_stack) : undo_stack_redo(&v->undo_stack));
        return;
    }
    if (to->scene != before.scene)
        snprintf(name, sizeof(name), "back to %s", v->viewport->state.scene.name);
    print_cost(&before, to, clock_seconds() - start, cost, sizeof(cost));
    snprintf(words, sizeof(words), "%s: %s%s", again ? "redo" : "undo", name, cost);
    if (*cost)
        rebuild_log_add(&v->rebuild_log, words);
    ui_show_message(v->ui, words);
}

/* ---- presets ---- */

void view_load_preset(struct view *v, const char *path)
{
    char words[TEXT_SIZE];
    struct setup_scene scene = v->viewport->state.scene;
    struct view_state state = view_state_now(v);
    scene.settings = settings_default();
    scene.preset = path;
    view_clear_errors(v);
    if (setup_apply_preset(&scene) != STATUS_OK) {
        view_fail(v, "the preset was not loaded");
        return;
    }
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(&scene.settings, row);
        if (settings_source(&scene.settings, row) == SETTING_PRESET) {
            settings_put(&state.settings, row, value, SETTING_USER);
            settings_put(&state.user_settings, row, value, SETTING_USER);
        }
    }
    if (!view_edit(v, &state, 0))
        return;
    snprintf(words, sizeof(words), "settings loaded from %s", path);
    ui_show_message(v->ui, words);
}

/* Prints the settings that have the default value although the scene has a different value. */
static void print_defaults(const struct view *v, const struct view_state *state, FILE *out)
{
    const struct settings scene_settings = view_scene_settings(v);
    const struct settings defaults = settings_default();
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(&state->settings, row);
        const double default_value = settings_get(&defaults, row);
        const double own = settings_get(&scene_settings, row);
        if (value < default_value || value > default_value ||
            !(own < default_value || own > default_value))
            continue;
        fprintf(out, "%s=", row->name);
        settings_print(&state->settings, row, out);
        fputc('\n', out);
    }
}

static char *print_preset(const struct view *v, const struct view_state *state, size_t *size)
{
    char *text = NULL;
    FILE *out = open_memstream(&text, size);
    if (!out)
        return NULL;
    fputs("# settings for firn --preset\n", out);
    settings_print_changes(&state->settings, "", out);
    print_defaults(v, state, out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

void view_save_preset(struct view *v)
{
    char words[TEXT_SIZE];
    size_t size = 0;
    const struct view_state state = view_state_now(v);
    char *folder = user_files_presets(true);
    char *path = folder ? user_files_new(folder, "preset", ".txt") : NULL;
    char *text = path ? print_preset(v, &state, &size) : NULL;
    if (text && file_io_write(path, text, size) == STATUS_OK) {
        snprintf(words, sizeof(words), "saved %s", path);
        ui_show_message(v->ui, words);
    } else {
        ui_show_failure(v->ui, "the preset was not saved: set HOME or XDG_DATA_HOME to a writable "
                               "folder");
    }
    free(text);
    free(path);
    free(folder);
}

/* ---- files ---- */

struct opening {
    struct view *view;
    const char *path;
    enum file_kind kind;
};

static enum status detect_kind(void *user)
{
    struct opening *opening = user;
    const struct reader_params *reader = &opening->view->viewport->state.scene.reader;
    return file_kind_detect(opening->path, reader, &opening->kind);
}

static enum status open_file(void *user)
{
    const struct opening *opening = user;
    bool remade;
    return viewport_load(&opening->view->viewport, opening->path, &remade);
}

static void load(struct view *v, struct opening *opening)
{
    const double start = clock_seconds();
    char words[REBUILD_LOG_SIZE];
    const struct view_state before = view_state_now(v);
    view_set_title(v, "loading");
    presenter_disconnect(&v->presenter);
    view_compare_stop(v);
    view_clear_errors(v);
    if (undo_scenes_add(&v->undo_scenes, v->scene, v->viewport) != STATUS_OK ||
        worker_run(&v->window, open_file, opening) != STATUS_OK) {
        view_fail(v, "the file was not opened");
    } else {
        view_enter_scene(v, &before);
        snprintf(words, sizeof(words), "%s %s (scene loaded in %.0f ms)",
                 opening->kind == FILE_KIND_ENVIRONMENT ? "opened environment" : "opened",
                 opening->path, (clock_seconds() - start) * 1e3);
        rebuild_log_add(&v->rebuild_log, words);
        ui_show_message(v->ui, words);
        recent_files_add(opening->path);
    }
    v->changed = true;
    view_show_name(v);
    view_frame_stats_exclude(&v->frame_stats, start);
}

/* Opens any kind of file. On failure, logs an error and leaves the current scene open. */
void view_open(struct view *v, const char *path)
{
    struct opening opening = { .view = v, .path = path };
    const double start = clock_seconds();
    if (view_compare_accepts(v, path)) {
        view_compare_open(v, path);
        return;
    }
    view_clear_errors(v);
    const enum status status = worker_run(&v->window, detect_kind, &opening);
    view_frame_stats_exclude(&v->frame_stats, start);
    if (status != STATUS_OK)
        view_fail(v, "the file was not opened");
    else if (opening.kind == FILE_KIND_SESSION)
        view_load_session(v, path);
    else if (opening.kind == FILE_KIND_PRESET)
        view_load_preset(v, path);
    else if (opening.kind == FILE_KIND_IMAGE)
        view_compare_open(v, path);
    else
        load(v, &opening);
}
