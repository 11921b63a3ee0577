/* view_session.c: opens and saves sessions. */
#define _GNU_SOURCE /* for realpath */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/scene/bundled_assets.h"
#include "src/view/session/recent_files.h"
#include "src/view/session/session_file.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

enum status view_read_session(struct session_file *session, const char *path,
                              const struct reader_params *reader)
{
    struct preset lines = { 0 };
    enum status status = preset_read(&lines, path, reader);
    if (status == STATUS_OK)
        status = session_file_parse(session, &lines, path);
    preset_finish(&lines);
    return status;
}

void view_apply_session(const struct session_file *session, struct setup_image *state)
{
    struct setup_scene *scene = &state->scene;
    scene->name = session->scene;
    scene->environment = session->environment;
    scene->env_rotate = session->environment ? session->env_rotate : 0.0f;
    scene->env_exposure = session->environment ? session->env_exposure : 0.0f;
    scene->settings = session->settings;
    settings_set_sources(&scene->settings, SETTING_USER); /* all come from the session */
    scene->user_settings = scene->settings;
    scene->has_default_environment = setup_is_stage_environment(scene->name, session->environment);
    scene->ground = (struct stage_params){ 0 };
    scene->animation = scene->surroundings = scene->material = NULL;
    scene->cracks = scene->bump = scene->bump_mask = scene->air = NULL;
    scene->material_override_count = 0;
    scene->object_transform_count = session->object_transform_count;
    memcpy(scene->object_transforms, session->object_transforms, sizeof(scene->object_transforms));
    scene->background.is_given = false;
    state->refraction = session->refraction;
    state->is_refraction_named = true;
    state->split = NULL;
    state->camera = NULL;
    state->eye.is_given = state->target.is_given = state->orbit.is_given = false;
}

/* Resets the source of settings with the scene's value, so that another scene can change them. */
static void unmark_scene_settings(struct view *v)
{
    const struct settings *given = &v->options->image->scene.settings;
    struct setup_scene *scene = &v->viewport->state.scene;
    const struct asset *environment = setup_default_environment(scene->name);
    const struct settings own = view_scene_settings(v);
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        const double value = settings_get(&scene->settings, row);
        const double scene_value = settings_get(&own, row);
        if (value < scene_value || value > scene_value ||
            settings_source(given, row) == SETTING_USER)
            continue;
        settings_copy(&scene->settings, row, &own);
        settings_copy(&scene->user_settings, row, given);
    }
    scene->has_default_environment =
        setup_is_stage_environment(scene->name, scene->environment) ||
        (environment && scene->environment && !strcmp(scene->environment, environment->name));
}

enum status view_resume_session(struct view *v, const struct session_file *session)
{
    unmark_scene_settings(v);
    v->scene = ++v->scene_count;
    struct view_state state = view_state_now(v);
    if (session->camera.fov_deg > 0.0f)
        view_use_camera(v, &session->camera);
    v->elapsed = 0.0;
    v->elapsed = (double)session->time - (double)view_time(v);
    v->undo_stack.count = v->undo_stack.at = 0;
    undo_scenes_prune(&v->undo_scenes, NULL);
    view_compare_choose(v, &state, VIEW_SIDE_B_NONE);
    v->compare.has_stored = false;
    v->changed = true;
    return view_compare_use(v, &state);
}

struct loading {
    struct view *view;
    const char *path;
    struct session_file session;
};

static enum status load(void *user)
{
    struct loading *loading = user;
    struct view *v = loading->view;
    struct setup_image state = v->viewport->state;
    enum status status = view_read_session(&loading->session, loading->path, &state.scene.reader);
    if (status != STATUS_OK)
        return status;
    view_apply_session(&loading->session, &state);
    return viewport_apply_state(&v->viewport, &state);
}

void view_load_session(struct view *v, const char *path)
{
    struct loading loading = { .view = v, .path = path };
    const double start = clock_seconds();
    view_set_title(v, "loading a session");
    presenter_disconnect(&v->presenter);
    view_compare_stop(v);
    view_clear_errors(v);
    enum status status = worker_run(&v->window, load, &loading);
    if (status == STATUS_OK)
        status = view_resume_session(v, &loading.session);
    if (status == STATUS_OK)
        ui_show_message(v->ui, "session opened");
    else
        view_fail(v, "the session was not opened");
    session_file_finish(&loading.session);
    v->changed = true;
    view_show_name(v);
    view_frame_stats_exclude(&v->frame_stats, start);
}

/* Returns the absolute path of a file, because the current folder may change. Returns a copy of
 * `name` if it is a built-in name. Returns NULL if out of memory. */
static char *absolute_name(const char *name)
{
    const bool is_file = !scene_find_builtin(name) && !asset_find(name, ASSET_SCENE) &&
                         !asset_find(name, ASSET_ENVIRONMENT) && !asset_is_valley(name);
    char *path = is_file ? realpath(name, NULL) : NULL;
    return path ? path : strdup(name);
}

/* Returns the first option or feature in use that sessions cannot store; NULL if none. */
static const char *unsupported(const struct view *v)
{
    const struct setup_scene *s = &v->viewport->state.scene;

    const struct {
        bool is_there;
        const char *name;
    } all[] = {
        { s->surroundings, "--surroundings" },
        { s->cracks, "--cracks" },
        { s->bump, "--bump" },
        { s->bump_mask, "--bump-mask" },
        { s->air, "--air" },
        { s->animation, "--animation" },
        { s->material_override_count, "--material NODE=..." },
        { s->background.is_given, "--background" },
        { s->ground.ground > STAGE_NONE, "--ground" },
        { v->compare.side_b != VIEW_SIDE_B_NONE, "side B" },
    };

    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
        if (all[i].is_there)
            return all[i].name;
    }
    return NULL;
}

static void print_session(const struct view *v, FILE *out)
{
    const struct setup_scene *s = &v->viewport->state.scene;
    const struct view_state state = view_state_now(v);
    char *scene = absolute_name(s->name);
    char *environment = s->environment ? absolute_name(s->environment) : NULL;
    struct session_file session = {
        .scene = scene ? scene : s->name,
        .environment = environment,
        .env_rotate = state.env_rotate,
        .env_exposure = s->env_exposure,
        .refraction = state.refraction,
        .settings = state.settings,
        .camera = v->viewport->camera,
        .time = view_time(v),
        .object_transform_count = s->object_transform_count,
    };
    memcpy(session.object_transforms, s->object_transforms, sizeof(session.object_transforms));
    session_file_print(&session, out);
    free(environment);
    free(scene);
}

void view_save_session(struct view *v)
{
    view_save_text(v, "session", ".firn", print_session, unsupported(v));
}
