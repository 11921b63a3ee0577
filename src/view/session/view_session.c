/* view_session.c: opens and saves sessions. */
#define _GNU_SOURCE /* for realpath */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/scene/bundled_assets.h"
#include "src/view/session/recent_files.h"
#include "src/view/session/session_file.h"
#include "src/view/session/xdg_folders.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

_Static_assert((int)SESSION_FILE_BOOKMARK_COUNT == (int)VIEW_BOOKMARK_COUNT,
               "sessions keep all bookmarks");

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
    scene->env_rotate = session->environment ? session->state.env_rotate : 0.0f;
    scene->env_exposure = session->environment ? session->env_exposure : 0.0f;
    scene->settings = session->state.settings;
    settings_set_sources(&scene->settings, SETTING_USER); /* all come from the session */
    scene->user_settings = scene->settings;
    scene->has_default_environment = false;
    scene->animation = scene->surroundings = scene->material = NULL;
    scene->cracks = scene->bump = scene->bump_mask = scene->air = NULL;
    scene->material_override_count = 0;
    scene->background.is_given = false;
    state->refraction = session->state.refraction;
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
        environment && scene->environment && !strcmp(scene->environment, environment->name);
}

enum status view_resume_session(struct view *v, const struct session_file *session)
{
    unmark_scene_settings(v);
    v->scene = ++v->scene_count;
    struct view_state state = view_state_now(v);
    if (session->has_camera)
        view_use_camera(v, &session->camera);
    memcpy(v->bookmarked, session->bookmarked, sizeof(v->bookmarked));
    memcpy(v->bookmarks, session->bookmarks, sizeof(v->bookmarks));
    v->elapsed = 0.0;
    v->elapsed = (double)session->time - (double)view_time(v);
    v->undo_stack.count = v->undo_stack.at = 0;
    undo_scenes_prune(&v->undo_scenes, NULL);
    state.side_b = session->state.side_b;
    state.split = session->state.split;
    state.right_settings = session->state.right_settings;
    v->compare.has_stored = state.side_b == VIEW_SIDE_B_STATE;
    v->compare.stored = state;
    v->compare.stored.refraction = state.split;
    v->compare.stored.settings = state.right_settings;
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
    view_set_title(v, "loading");
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
        { v->compare.side_b == VIEW_SIDE_B_FILE, "the image on side B" },
    };

    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
        if (all[i].is_there)
            return all[i].name;
    }
    return NULL;
}

static char *print(const struct view *v, const char *scene, const char *environment, size_t *size)
{
    const struct session_file session = {
        .scene = scene,
        .environment = environment,
        .env_exposure = v->viewport->state.scene.env_exposure,
        .state = view_state_now(v),
        .camera = v->viewport->camera,
        .time = view_time(v),
    };
    struct session_file all = session;
    char *text = NULL;
    memcpy(all.bookmarked, v->bookmarked, sizeof(all.bookmarked));
    memcpy(all.bookmarks, v->bookmarks, sizeof(all.bookmarks));
    FILE *out = open_memstream(&text, size);
    if (!out)
        return NULL;
    session_file_print(&all, out);
    if (fclose(out) == 0)
        return text;
    free(text);
    return NULL;
}

void view_save_session(struct view *v)
{
    const struct setup_scene *s = &v->viewport->state.scene;
    char words[600];
    size_t size = 0;
    char *folder = user_files_sessions(true);
    char *path = folder ? user_files_new(folder, "session", ".firn") : NULL;
    char *scene = absolute_name(s->name);
    char *environment = s->environment ? absolute_name(s->environment) : NULL;
    char *text = path && scene ? print(v, scene, environment, &size) : NULL;
    if (text && file_io_write(path, text, size) == STATUS_OK) {
        const char *out = unsupported(v);
        snprintf(words, sizeof(words), "saved %s%s%s", path, out ? " without " : "",
                 out ? out : "");
        ui_show_message(v->ui, words);
    } else {
        ui_show_failure(v->ui, "the session was not saved: set HOME or XDG_DATA_HOME to a writable "
                               "folder");
    }
    free(text);
    free(environment);
    free(scene);
    free(path);
    free(folder);
}
