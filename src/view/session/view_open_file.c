/* view_open_file.c: opens a file of any kind: model, environment, preset, session or image. */
#include <stdio.h>
#include "src/base/clock.h"
#include "src/view/session/file_kind.h"
#include "src/view/session/recent_files.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

struct opening {
    struct view *view;
    const char *path;
    const struct setup_scene *scene; /* options for the scene that is open; NULL: another file */
    const char *change;              /* how `scene` differs from the options in use */
    enum opened_kind kind;
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
    struct viewport **viewport = &opening->view->viewport;
    bool remade;
    if (!opening->scene) /* files may have changed on disk */
        loaded_files_drop_environment(&opening->view->files);
    if (!opening->scene && opening->kind != FILE_KIND_ENVIRONMENT)
        loaded_files_finish(&opening->view->files);
    return opening->scene ? viewport_reload(viewport, opening->scene)
                          : viewport_load(viewport, opening->path, &remade);
}

/* Writes what was done to the status bar. */
static void describe(const struct view *v, const struct opening *opening, double seconds)
{
    char words[200];
    if (opening->scene)
        snprintf(words, sizeof(words), "%s (scene loaded in %.0f ms)", opening->change,
                 seconds * 1e3);
    else
        snprintf(words, sizeof(words), "%s %s (scene loaded in %.0f ms)",
                 opening->kind == FILE_KIND_ENVIRONMENT ? "opened environment" : "opened",
                 opening->path, seconds * 1e3);
    ui_show_message(v->ui, words);
}

static void load(struct view *v, struct opening *opening)
{
    const double start = clock_seconds();
    const struct view_state before = view_state_now(v);
    char words[200];
    snprintf(words, sizeof(words), "%s %s", opening->scene ? "applying" : "loading",
             opening->scene ? opening->change : opening->path);
    view_set_title(v, words);
    presenter_disconnect(&v->presenter);
    view_compare_stop(v);
    view_clear_errors(v);
    if (undo_scenes_add(&v->undo_scenes, v->scene, v->viewport, v->scene_change) != STATUS_OK ||
        worker_run(&v->window, open_file, opening) != STATUS_OK) {
        view_fail(v, opening->scene ? "nothing was changed" : "the file was not opened");
    } else {
        view_enter_scene(v, &before);
        describe(v, opening, clock_seconds() - start);
        snprintf(v->scene_change, sizeof(v->scene_change), "%s",
                 opening->scene ? opening->change : "");
        if (!opening->scene) {
            *v->selected_name = '\0';
            recent_files_add(opening->path);
        }
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

void view_reload_scene(struct view *v, const struct setup_scene *scene, const char *words)
{
    load(v, &(struct opening){ .view = v, .scene = scene, .change = words });
}

void view_replace_materials(struct view *v, const struct material_choice *choice)
{
    struct setup_scene scene = v->viewport->state.scene;
    char material[64];
    char words[128];
    if (scene_find_builtin(scene.name)) {
        ui_show_message(v->ui, "the materials of this scene cannot be replaced");
        return;
    }
    snprintf(material, sizeof(material), "%s%s%s", choice->preset->name, choice->finish ? ":" : "",
             choice->finish ? choice->finish->name : "");
    snprintf(words, sizeof(words), "--material %s", material);
    scene.material = material;
    scene.material_override_count = 0;
    scene.exposure.is_chosen = false;
    view_reload_scene(v, &scene, words);
}
