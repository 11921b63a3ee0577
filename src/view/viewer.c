/* viewer.c: viewer: startup, frame loop and shutdown of the interactive window. */
#include "src/view/viewer.h"
#include <stdio.h>
#include <stdlib.h>
#include "src/base/clock.h"
#include "src/base/log.h"
#include "src/view/panels/ui_busy_box.h"
#include "src/view/session/recent_files.h"
#include "src/view/shader_reload.h"
#include "src/view/view_internal.h"
#include "src/view/window/worker_thread.h"

/* Minimum time between device losses, seconds; a device that is lost sooner is not reopened. */
#define RECOVERY_SECONDS 60.0

/* time without size changes before the renderer is resized, seconds */
static const double rest_seconds = 0.12;
static const double busy_seconds = 0.2; /* delay before a job shows a spinner, seconds */
static const double idle_seconds = 0.1; /* poll interval while nothing is drawn, seconds */

/* ---- startup and shutdown ---- */

static bool shows_panels(const struct viewer_params *o)
{
    const bool is_interactive = !o->window->frame_count && !o->outputs->count;
    return o->window->overlay == SETUP_OVERLAY_ON ||
           (is_interactive && o->window->overlay == SETUP_OVERLAY_AUTO);
}

/* Returns the window size for the image size of --size, limited to `room` if panels are shown. */
static VkExtent2D fit_window(void *user, float scale, VkExtent2D room)
{
    struct view *v = user;
    const struct setup_image *p = v->options->image;
    const VkExtent2D image = { p->width, p->height };
    const float given = v->options->window->ui_scale;
    v->ui_scale = given > 0.0f ? given : scale;
    if (!shows_panels(v->options))
        return image;
    const VkExtent2D size = window_layout_for_image(image, v->ui_scale);
    return (VkExtent2D){
        room.width && room.width < size.width ? room.width : size.width,
        room.height && room.height < size.height ? room.height : size.height,
    };
}

/* Shows a spinner and what the worker thread does, in the middle of the image. */
static void show_busy(void *user, double seconds)
{
    struct view *v = user;
    const VkExtent2D size = window_size(&v->window);
    const VkRect2D image = v->layout.image;
    if (!v->ui || seconds < busy_seconds || !size.width || v->options->window->frame_count)
        return;
    const struct ui_busy_box box =
        ui_busy_box_draw(v->ui, *v->busy ? v->busy : "rebuilding", seconds);
    if (box.pixels)
        window_show_pixels(&v->window, image.extent.width ? image : (VkRect2D){ .extent = size },
                           box.pixels, (VkExtent2D){ box.width, box.height });
    free(box.pixels);
}

/* Ends the program without waiting for the running job, which may take seconds. With --frames, only
 * hides the window, since images may have to be written. */
static void end_during_job(void *user)
{
    struct view *v = user;
    window_hide(&v->window);
    if (v->options->window->frame_count)
        return;
    if (!v->options->quiet)
        view_frame_stats_print(&v->frame_stats, stderr);
    signals_exit(&v->signals, v->message_count ? STATUS_FAILED : STATUS_OK);
}

static enum status open_window(struct view *v)
{
    const struct window_params params = {
        .fit = fit_window,
        .user = v,
        .title = "firn: loading",
        .background = theme_at(v->theme)->surround,
    };
    enum status status = window_init(&v->window, &params);
    v->window.show_busy = show_busy;
    v->window.end = end_during_job;
    v->window.busy_user = v;
    if (status == STATUS_OK)
        status = window_system(&v->window, &v->system);
    return status;
}

static enum status open_device(void *user)
{
    struct view *v = user;
    struct gpu_params params = v->options->gpu;
    if (shows_panels(v->options) || !v->options->window->frame_count)
        ui_thumbnails_load(&v->thumbnails, &v->initial_state.scene.reader);
    params.windows = &v->system;
    enum status status = gpu_create(&v->gpu, &params);
    if (status == STATUS_OK)
        status = window_surface(&v->window, &v->gpu, &v->surface);
    if (status == STATUS_OK)
        status = presenter_init(&v->presenter, &v->gpu, v->surface, v->options->window->present);
    return status;
}

static enum status load(void *user)
{
    struct view *v = user;
    if (v->viewport)
        return viewport_upload(v->viewport);
    return viewport_create(&v->viewport, &v->gpu, &v->initial_state, v->shader_reload,
                           v->options->quiet, !v->options->window->frame_count);
}

static enum status open_ui(struct view *v)
{
    const struct viewer_params *o = v->options;
    const enum status status =
        ui_create(&v->ui, &v->gpu, v->ui_scale, theme_at(v->theme), &v->thumbnails, o->quiet);
    if (status != STATUS_OK)
        return status;
    window_set_listener(&v->window, ui_handle_event, v->ui);
    ui_dump(v->ui, o->window->ui_dump);
    view_show_ui(v, shows_panels(o));
    return STATUS_OK;
}

/* Frees everything that belongs to the device. Window, scene, settings and camera remain. */
static void leave_device(struct view *v)
{
    v->window.listen = NULL;
    presenter_finish(&v->presenter);
    view_compare_stop(v);
    if (v->gpu.device) {
        pixel_inspector_finish(&v->inspector, &v->gpu);
        comparison_image_leave_device(&v->compare.file, &v->gpu);
        comparison_image_leave_device(&v->compare.reference, &v->gpu);
        comparison_image_leave_device(&v->compare.error_image, &v->gpu);
    }
    ui_destroy(v->ui);
    viewport_leave_device(v->viewport);
    if (v->surface)
        vkDestroySurfaceKHR(v->gpu.instance, v->surface, NULL);
    gpu_destroy(&v->gpu);
    v->ui = NULL;
    v->surface = VK_NULL_HANDLE;
    v->message_count += v->gpu.message_count;
    v->gpu.message_count = 0;
}

static void finish(struct view *v)
{
    leave_device(v);
    flip_error_map_finish(&v->compare.flip_map);
    image_finish(&v->compare.file.linear);
    session_file_finish(&v->session);
    ui_thumbnails_finish(&v->thumbnails);
    scene_objects_finish(&v->objects);
    viewport_destroy(v->viewport);
    loaded_files_finish(&v->files);
    undo_scenes_prune(&v->undo_scenes, NULL);
    shader_reload_destroy(v->shader_reload);
    window_finish(&v->window);
}

/* ---- frames ---- */

/* Advances the scene time and waits until a frame is due. Returns false if none is due yet. */
static bool wait_for_frame(struct view *v, VkExtent2D size)
{
    const struct setup_window *o = v->options->window;
    const double before = v->now;
    const bool counted = o->frame_count != 0;
    v->now = clock_seconds();
    if (!v->paused && o->time_step <= 0.0 && v->frame_stats.frame_count)
        v->elapsed += v->now - before;
    const bool idle =
        v->paused && !v->changed && !counted && !ui_is_busy(v->ui) && !(v->resize_at > 0.0);
    const double rest = view_progressive_wait(v);
    if (size.width != 0 && !idle)
        return true;
    window_wait(&v->window, rest > 0.0 && rest < idle_seconds ? rest : idle_seconds);
    view_frame_stats_pause(&v->frame_stats);
    return false;
}

static enum status resize(void *user)
{
    struct view *v = user;
    return viewport_resize(v->viewport, v->requested_size);
}

/* Resizes the renderer to the image area. During a drag of the window's edge, the last image is
 * scaled instead, because a new renderer takes longer than a frame. */
static enum status fit_image(struct view *v, bool window_changed)
{
    const struct viewport *p = v->viewport;
    const VkExtent2D room = v->layout.image.extent;
    const bool waits = window_changed && p->renderer && !v->options->window->frame_count;
    if (p->renderer && p->state.width == room.width && p->state.height == room.height) {
        v->resize_at = 0.0;
        return STATUS_OK;
    }
    if (!(v->resize_at > 0.0) || v->requested_size.width != room.width ||
        v->requested_size.height != room.height)
        v->resize_at = clock_seconds() + (waits ? rest_seconds : 0.0);
    v->requested_size = room;
    if (clock_seconds() < v->resize_at)
        return STATUS_OK;
    v->resize_at = 0.0;
    v->changed = true;
    presenter_disconnect(&v->presenter);
    if (!p->renderer)
        return resize(v);
    return worker_run(&v->window, resize, v);
}

/* Resizes swapchain and layout to the window. *ready is false if nothing can be drawn. */
static enum status fit_layout(struct view *v, VkExtent2D size, bool *ready, bool *remade)
{
    const enum status status = presenter_fit(&v->presenter, size, remade);
    *ready = status == STATUS_OK && !v->presenter.swapchain.stale;
    if (*ready)
        view_update_layout(v, v->presenter.swapchain.extent);
    return status;
}

/* Resizes swapchain, layout and renderer to the window. */
static enum status fit(struct view *v, VkExtent2D size, bool *ready)
{
    bool remade;
    const enum status status = fit_layout(v, size, ready, &remade);
    return *ready ? fit_image(v, remade) : status;
}

/* Makes the presentation plan use the current images. */
static enum status connect(struct view *v)
{
    const double start = clock_seconds();
    const struct presenter_images shown = {
        .left = viewport_left(v->viewport),
        .right = viewport_right(v->viewport),
        .extent = viewport_extent(v->viewport),
        .right_extent = viewport_right_extent(v->viewport),
    };
    const enum status status = presenter_connect(&v->presenter, &shown);
    view_frame_stats_exclude(&v->frame_stats, start);
    return status;
}

static struct renderer_shot shot_now(const struct view *v)
{
    return (struct renderer_shot){ .camera = v->viewport->camera, .time = view_time(v) };
}

static enum status pose_viewport(void *user)
{
    struct view *v = user;
    return viewport_pose(v->viewport, shot_now(v).time);
}

/* Poses an animated model for the current time, while the window handles events. If the model
 * cannot be read any more, pauses. */
static void pose(struct view *v)
{
    const double start = clock_seconds();
    const float time = shot_now(v).time;
    if (viewport_is_posed(v->viewport, time))
        return;
    presenter_disconnect(&v->presenter);
    view_compare_stop(v);
    v->changed = true;
    v->window.show_busy = NULL; /* a spinner in each frame would flicker */
    const enum status status = worker_run(&v->window, pose_viewport, v);
    v->window.show_busy = show_busy;
    if (status != STATUS_OK) {
        v->elapsed += (double)v->viewport->scene.time - (double)time;
        v->paused = true;
        view_show_name(v);
    }
    view_frame_stats_exclude(&v->frame_stats, start);
}

/* Draws the image unless it is unchanged. */
static enum status draw_image(struct view *v)
{
    const struct renderer_shot shot = shot_now(v);
    /* images of new renderers have no contents yet */
    const bool is_new = v->viewport->is_progressive &&
                        v->viewport->version != v->progressive.identity.renderer_version;
    const bool other = v->changed || shot.time < v->drawn_time || shot.time > v->drawn_time;
    v->redrawn = is_new || (other && !(v->resize_at > 0.0));
    if (!v->redrawn)
        return STATUS_OK;
    v->drawn_time = shot.time;
    v->changed = false;
    return v->viewport->is_progressive ? view_progressive_draw(v, &shot)
                                       : viewport_draw(v->viewport, &shot);
}

/* Presents the image and the user interface. */
static enum status present_frame(struct view *v, bool *ready)
{
    const struct overlay_draw_list *list = NULL;
    const struct viewport *p = v->viewport;
    enum status status = connect(v);
    if (status == STATUS_OK)
        status = presenter_begin(&v->presenter, ready);
    v->changed = v->changed || !*ready; /* draw again, as nothing was presented */
    if (status != STATUS_OK || !*ready)
        return status;
    if (v->presenter.font)
        list = ui_copy_draw_list(
            v->ui, rg_exec_mapped(v->presenter.exec, &overlay_vertices, v->presenter.slot),
            rg_exec_mapped(v->presenter.exec, &overlay_indices, v->presenter.slot));
    const bool divided = viewport_is_split(p) && !p->flipped && !v->compare.wants_error_map;
    v->image_area = present_fit(v->layout.image, viewport_extent(p), divided ? p->divider : -1.0);
    v->image_area.surround = theme_at(v->theme)->surround;
    const struct window_frame window = {
        .present = v->image_area,
        .layout = v->layout,
        .overlay = list,
    };
    return presenter_end(&v->presenter, &window);
}

/* Draws and presents a frame: the image and the user interface. */
static enum status draw(struct view *v, bool *ready)
{
    enum status status = draw_image(v);
    if (status == STATUS_OK) {
        view_inspect(v);
        status = view_compare_show(v);
    }
    return status == STATUS_OK ? present_frame(v, ready) : status;
}

/* Adds files named in options to the recent files, unless --frames is given (scripted runs). */
static void remember(const struct view *v)
{
    const char *environment = v->initial_state.scene.environment;
    if (v->options->window->frame_count)
        return;
    if (environment)
        recent_files_add(environment);
    if (!scene_find_builtin(v->initial_state.scene.name))
        recent_files_add(v->initial_state.scene.name);
}

/* Restores the parts of a session that need renderers and panels, after the first frame. */
static void begin_session(struct view *v)
{
    view_clear_errors(v);
    if (view_resume_session(v, &v->session) != STATUS_OK)
        view_fail(v, "the session was opened only in part");
    session_file_finish(&v->session);
}

static void count_frame(struct view *v)
{
    struct view_frame_stats *c = &v->frame_stats;
    const struct viewport *p = v->viewport;
    const struct setup_window *o = v->options->window;
    struct rg_times times[3] = { rg_exec_times(v->presenter.exec) };
    uint32_t count = 1;
    if (v->redrawn)
        times[count++] = renderer_times(viewport_renderer(p, false));
    if (v->redrawn && viewport_renderer(p, true))
        times[count++] = renderer_times(viewport_renderer(p, true));
    view_frame_stats_end(c, times, count, v->presenter.wait_seconds);
    if (p->is_progressive && !v->redrawn)
        c->last = (struct ui_frame_pacing){ 0 }; /* may have waited for a sample */
    if (p->is_progressive &&
        (v->redrawn || v->progressive.has_full_draft || v->progressive.shown_count == 1))
        view_frame_stats_image(c, v->redrawn);
    if (v->progressive.shown_count && !v->redrawn)
        view_frame_stats_sample(c);
    if (v->redrawn && p->is_progressive && !p->draft.is_off && c->last.frame > 0.0)
        dynamic_resolution_add(&v->progressive.dynamic_resolution, c->last.frame,
                               viewport_pass_seconds(p));
    if (c->frame_count == 1) {
        remember(v);
        if (v->session.scene)
            begin_session(v);
        view_show_name(v);
        v->now = clock_seconds();
    }
    if (o->time_step > 0.0 && !v->paused)
        v->elapsed += o->time_step;
    v->quit = v->quit || (o->frame_count && c->frame_count >= o->frame_count);
}

static enum status run_frame(struct view *v)
{
    bool ready;
    window_poll(&v->window);
    view_frame_stats_poll(&v->frame_stats, v->progressive.drew_part);
    v->progressive.drew_part = false;
    view_handle_input(v);
    view_compare_follow(v);
    const VkExtent2D size = window_size(&v->window);
    if (v->quit)
        return STATUS_OK;
    if (size.width != 0 && !v->changed && !ui_is_busy(v->ui)) {
        const enum status status = view_progressive_step(v, &ready);
        if (status != STATUS_OK || ready)
            return status;
    }
    if (!wait_for_frame(v, size))
        return STATUS_OK;
    view_run_ui(v, size);
    pose(v);
    enum status status = fit(v, size, &ready);
    if (status == STATUS_OK && ready)
        status = draw(v, &ready);
    if (status != STATUS_OK || !ready)
        return status;
    count_frame(v);
    if (v->wants_screenshot && !(v->resize_at > 0.0))
        view_take_screenshot(v);
    return v->frame_stats.frame_count == 1 ? view_progressive_begin(v) : STATUS_OK;
}

/* Creates the draft renderers, which can draw sooner than the others. */
static enum status create_first_draft(void *user)
{
    struct view *v = user;
    bool ready;
    bool remade;
    const struct renderer_shot shot = shot_now(v);
    const enum status status = fit_layout(v, v->initial_size, &ready, &remade);
    if (status != STATUS_OK || !ready)
        return status;
    v->viewport->state.width = v->layout.image.extent.width;
    v->viewport->state.height = v->layout.image.extent.height;
    return viewport_create_draft(v->viewport, &shot);
}

/* Shows the first image while the renderers of full quality do not exist yet. */
static enum status show_first_draft(struct view *v)
{
    const struct renderer_shot shot = shot_now(v);
    bool ready;
    view_run_ui(v, v->presenter.swapchain.extent);
    v->progressive.has_identity = false;
    const enum status status = view_progressive_draw(v, &shot);
    return status == STATUS_OK ? present_frame(v, &ready) : status;
}

/* Creates the renderers and draws once, which compiles their shaders. */
static enum status warm_up(void *user)
{
    struct view *v = user;
    bool ready;
    const struct renderer_shot shot = shot_now(v);
    enum status status = fit(v, v->initial_size, &ready);
    if (status != STATUS_OK || !ready)
        return status;
    status = viewport_warm_up(v->viewport, &shot);
    return status == STATUS_OK ? viewport_wait(v->viewport) : status;
}

/* Prepares the first frame on the worker thread, because this is slow. */
static enum status begin_image(struct view *v)
{
    enum status status = STATUS_OK;
    if (viewport_wants_draft(v->viewport)) {
        status = worker_run(&v->window, create_first_draft, v);
        if (status == STATUS_OK && v->viewport->draft.left)
            status = show_first_draft(v);
    }
    return status == STATUS_OK ? worker_run(&v->window, warm_up, v) : status;
}

/* Opens the device, loads the scene and creates the user interface, while the window is open. */
static enum status begin_device(struct view *v)
{
    char words[200];
    view_set_title(v, "loading the device");
    enum status status = worker_run(&v->window, open_device, v);
    if (status != STATUS_OK || window_is_closed(&v->window))
        return status;
    snprintf(words, sizeof(words), "loading %s", v->initial_state.scene.name);
    view_set_title(v, words);
    status = open_ui(v);
    if (status == STATUS_OK)
        status = worker_run(&v->window, load, v);
    if (status != STATUS_OK || window_is_closed(&v->window))
        return status;
    view_set_title(v, "loading shaders");
    v->presenter.replace = v->shader_reload ? shader_reload_replace : NULL;
    v->presenter.replace_user = v->shader_reload;
    v->initial_size = window_size(&v->window);
    return begin_image(v);
}

/* Opens the window first, so that the user sees it immediately. */
static enum status begin(struct view *v)
{
    const struct viewer_params *o = v->options;
    enum status status = viewport_can_save(o->image->split, o->outputs->paths, o->outputs->count);
    if (status == STATUS_OK && o->window->watch)
        status = shader_reload_create(&v->shader_reload, o->window->watch, o->quiet);
    if (status == STATUS_OK)
        status = open_window(v);
    return status == STATUS_OK ? begin_device(v) : status;
}

/* Closes a lost device and returns true, so that the caller can reopen it. Returns false for other
 * errors, and if the previous loss was less than RECOVERY_SECONDS ago. */
static bool leave_lost_device(struct view *v, enum status status)
{
    const bool is_recent =
        v->recovered_at > 0.0 && clock_seconds() - v->recovered_at < RECOVERY_SECONDS;
    if (status != STATUS_TRY_AGAIN || is_recent || !gpu_is_lost(&v->gpu))
        return false;
    v->recovered_at = clock_seconds();
    log_warning("the device was lost: reopening it once");
    leave_device(v);
    return true;
}

/* Reopens a lost device. The window shows its last image meanwhile. Returns other errors
 * unchanged. */
static enum status recover(struct view *v, enum status status)
{
    const bool has_ui = v->ui;
    const bool shown = v->presenter.font;
    if (!leave_lost_device(v, status))
        return status;
    status = begin_device(v);
    if (status == STATUS_OK && has_ui && v->ui)
        view_show_ui(v, shown);
    if (status == STATUS_OK)
        view_show_name(v);
    if (status == STATUS_OK && v->ui)
        view_fail(v, "the device was reopened");
    v->now = clock_seconds();
    return status;
}

/* Waits for the last frames and writes the outputs, again if the device is lost meanwhile. */
static enum status end(struct view *v)
{
    const bool writes = v->options->outputs->count && v->frame_stats.frame_count;
    enum status status = presenter_wait(&v->presenter);
    if (status == STATUS_OK && v->viewport && v->viewport->renderer)
        status = viewport_wait(v->viewport);
    if (!writes)
        return status;
    if (status == STATUS_OK)
        status = view_write_outputs(v);
    if (!leave_lost_device(v, status))
        return status;
    status = open_device(v);
    if (status == STATUS_OK)
        status = load(v);
    return status == STATUS_OK ? view_write_outputs(v) : status;
}

static enum status run(struct view *v)
{
    enum status status = recover(v, begin(v));
    v->quit = status == STATUS_OK && window_is_closed(&v->window);
    v->now = clock_seconds();
    while (status == STATUS_OK && !v->quit) {
        status = recover(v, run_frame(v));
        v->quit = v->quit || window_is_closed(&v->window);
    }
    return status == STATUS_OK ? end(v) : status;
}

enum status viewer_run(const struct viewer_params *options)
{
    struct view *v = calloc(1, sizeof(*v));
    if (!v) {
        return log_out_of_memory(NULL);
    }
    v->options = options;
    v->selected = SCENE_OBJECT_NONE;
    v->theme = options->window->theme;
    v->initial_state = *options->image;
    v->initial_state.scene.files = &v->files;
    const struct reader_params *reader = &options->image->scene.reader;
    enum status status = STATUS_OK;
    if (options->window->session)
        status = view_read_session(&v->session, options->window->session, reader);
    v->initial_state.scene.user_settings = v->initial_state.scene.settings;
    if (v->session.scene)
        view_apply_session(&v->session, &v->initial_state);
    if (!v->initial_state.samples)
        v->initial_state.samples = options->window->frame_count ? 1 : VIEW_SAMPLE_COUNT;
    v->progressive.target_count = v->initial_state.samples;
    v->compare.side_b = v->initial_state.split ? VIEW_SIDE_B_MODEL : VIEW_SIDE_B_NONE;
    v->paused = !options->window->frame_count && !(options->window->time_step > 0.0);
    if (status == STATUS_OK)
        status = signals_begin(&v->signals);
    view_capture_errors(v);
    if (status == STATUS_OK)
        status = run(v);
    if (status == STATUS_OK && !options->quiet)
        view_frame_stats_print(&v->frame_stats, stderr);
    finish(v);
    view_release_errors(v);
    if (status == STATUS_OK && v->message_count)
        status = STATUS_FAILED; /* the validation layer has logged the reason */
    signals_end(&v->signals);
    free(v);
    return status;
}
