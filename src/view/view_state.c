/* view_state.c: title, messages, scene time, layout, camera and current settings of the viewer. */
#define _GNU_SOURCE /* for fopencookie */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "src/render/frame/pass_list.h"
#include "src/settings/scene_settings.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

void view_set_title(struct view *v, const char *what)
{
    char title[256];
    snprintf(title, sizeof(title), "firn: %s", what);
    snprintf(v->busy, sizeof(v->busy), "%s", what);
    window_title(&v->window, title);
}

static bool begins(const char *text, size_t size, const char *prefix)
{
    return size >= strlen(prefix) && !memcmp(text, prefix, strlen(prefix));
}

/* Writes to the original stderr and keeps error messages, but not warnings and notes. */
static ssize_t capture(void *user, const char *text, size_t size)
{
    static const char prefix[] = "firn: ";
    struct view *v = user;
    if (begins(text, size, prefix) && !begins(text, size, "firn: warning: ") &&
        !begins(text, size, "firn: note: ")) {
        pthread_mutex_lock(&v->error_lock);
        snprintf(v->error, sizeof(v->error), "%.*s", (int)(size - strlen(prefix)),
                 text + strlen(prefix));
        v->error[strcspn(v->error, "\n")] = '\0';
        pthread_mutex_unlock(&v->error_lock);
    }
    return write(STDERR_FILENO, text, size);
}

void view_capture_errors(struct view *v)
{
    FILE *stream = fopencookie(v, "w", (cookie_io_functions_t){ .write = capture });
    pthread_mutex_init(&v->error_lock, NULL);
    if (!stream)
        return;
    setvbuf(stream, NULL, _IONBF, 0); /* unbuffered like stderr, so that messages appear at once */
    v->original_stderr = stderr;
    stderr = stream;
}

void view_release_errors(struct view *v)
{
    FILE *stream = stderr;
    if (v->original_stderr) {
        stderr = v->original_stderr;
        (void)fclose(stream);
    }
    pthread_mutex_destroy(&v->error_lock);
}

void view_clear_errors(struct view *v)
{
    pthread_mutex_lock(&v->error_lock);
    *v->error = '\0';
    pthread_mutex_unlock(&v->error_lock);
}

void view_fail(struct view *v, const char *what)
{
    char words[sizeof(v->error) + 64];
    pthread_mutex_lock(&v->error_lock);
    snprintf(words, sizeof(words), "%s%s%s", what, *v->error ? ": " : "", v->error);
    *v->error = '\0';
    pthread_mutex_unlock(&v->error_lock);
    ui_show_failure(v->ui, words);
}

void view_show_name(struct view *v)
{
    static const char *const other[] = {
        [VIEW_SIDE_B_FILE] = "image", [VIEW_SIDE_B_REFERENCE] = "reference"
    };
    const struct setup_image *p = &v->viewport->state;
    char words[200];
    if (v->compare.side_b != VIEW_SIDE_B_NONE)
        snprintf(words, sizeof(words), "%s, %s | %s%s", p->scene.name,
                 p->refraction->refraction.name,
                 p->split ? p->split->refraction.name : other[v->compare.side_b],
                 v->paused ? ", paused" : "");
    else
        snprintf(words, sizeof(words), "%s%s", p->scene.name, v->paused ? ", paused" : "");
    view_set_title(v, words);
    *v->busy = '\0';
}

void view_show_ui(struct view *v, bool shown)
{
    ui_show(v->ui, shown);
    presenter_set_font(&v->presenter, shown ? ui_font(v->ui) : NULL);
}

void view_update_layout(struct view *v, VkExtent2D size)
{
    v->layout = window_layout_of(size, v->ui_scale, v->presenter.font != NULL);
    v->window.image_area = v->layout.image;
}

float view_time(const struct view *v)
{
    const struct motion_params *motion =
        settings_of(&v->viewport->state.scene.settings, &motion_settings);
    return (float)((double)motion->time + v->elapsed);
}

void view_seek(struct view *v, float time)
{
    v->elapsed += fmax((double)time, 0.0) - (double)view_time(v);
    v->changed = true;
}

static enum status rebuild(void *user)
{
    struct view *v = user;
    return viewport_rebuild(v->viewport);
}

/* Sets the camera. If the projection changes, replaces the renderers. */
void view_use_camera(struct view *v, const struct camera *camera)
{
    struct viewport *p = v->viewport;
    const struct camera before = p->camera;
    const bool other = (camera->height > 0.0f) != (before.height > 0.0f);
    p->camera = *camera;
    if (!other)
        return;
    presenter_disconnect(&v->presenter);
    view_clear_errors(v);
    if (worker_run(&v->window, rebuild, v) == STATUS_OK)
        return;
    p->camera = before;
    view_fail(v, "the projection was not changed");
}

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
