/* view.c: the loop around a window. */
#include "src/view/view.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>
#include "src/app/stop.h"
#include "src/log.h"
#include "src/scene_settings.h"
#include "src/view/background.h"
#include "src/view/orbit.h"
#include "src/view/picture.h"
#include "src/view/screen.h"
#include "src/view/watch.h"
#include "src/view/window.h"

static const float key_turn_deg = 5.0f;
static const float drag_turn_deg = 180.0f; /* over the window's height */
static const double key_slide = 1.0 / 32;  /* of the window's width */
static const double idle_seconds = 0.1;    /* between looks, while there is nothing to draw */

/* What frames cost, but for the first one, which compiles shaders. */
struct costs {
    uint32_t frame_count;
    double start;  /* seconds; end of the first frame */
    double rest;   /* seconds in which nothing was to be done: limits, pauses, files */
    double graphs; /* seconds of passes on the device */
};

struct view {
    const struct app_options *options;
    struct stop stop;
    struct window window;
    struct gpu_window_system system;
    struct gpu gpu;
    VkSurfaceKHR surface;
    struct screen screen;
    struct picture *picture;
    struct watch *watch; /* NULL: no shaders are watched */
    double now;          /* of the loop, seconds */
    double elapsed;      /* of the scene's time, seconds, from motion.time */
    float shown;         /* time of the frame drawn last, seconds */
    double next;         /* the earliest moment for the next frame, seconds */
    bool paused, changed, quit;
    VkExtent2D first_size; /* of the window, pixels */
    bool shoot;            /* the next frame, to files */
    uint32_t shot_number;  /* of the screenshot written last */
    struct costs costs;
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* ---- start and end ---- */

static void say(struct view *v, const char *what)
{
    char title[256];
    snprintf(title, sizeof(title), "firn: %s", what);
    window_title(&v->window, title);
}

static enum status open_window(struct view *v)
{
    const struct app_options *o = v->options;
    const uint32_t width = o->width ? o->width : 1024;
    const uint32_t height = o->height ? o->height : 768;
    enum status status = window_init(&v->window, width, height, "firn: loading");
    if (status == STATUS_OK)
        status = window_system(&v->window, &v->system);
    return status;
}

static enum status open_device(void *user)
{
    struct view *v = user;
    const struct app_options *o = v->options;
    const struct gpu_params params = {
        .device = o->device,
        .validate = o->validate,
        .no_cache = o->no_cache,
        .windows = &v->system,
    };
    const VkPresentModeKHR mode = o->present ? o->present : VK_PRESENT_MODE_FIFO_KHR;
    enum status status = gpu_create(&v->gpu, &params);
    if (status == STATUS_OK)
        status = window_surface(&v->window, &v->gpu, &v->surface);
    if (status == STATUS_OK)
        status = screen_init(&v->screen, &v->gpu, v->surface, mode);
    return status;
}

static void show_name(struct view *v)
{
    const struct app_options *o = &v->picture->o;
    char words[200];
    if (o->split)
        snprintf(words, sizeof(words), "%s, %s | %s%s", o->positionals[0], o->rung->name,
                 o->split->name, v->paused ? ", paused" : "");
    else
        snprintf(words, sizeof(words), "%s%s", o->positionals[0], v->paused ? ", paused" : "");
    say(v, words);
}

static enum status load(void *user)
{
    struct view *v = user;
    return picture_create(&v->picture, &v->gpu, v->options, v->watch);
}

static void finish(struct view *v)
{
    screen_finish(&v->screen);
    picture_destroy(v->picture);
    if (v->surface)
        vkDestroySurfaceKHR(v->gpu.instance, v->surface, NULL);
    watch_destroy(v->watch);
    gpu_destroy(&v->gpu);
    window_finish(&v->window);
}

static void report(const struct view *v)
{
    const struct costs *c = &v->costs;
    const uint32_t count = c->frame_count;
    if (v->options->quiet)
        return;
    if (count < 2) {
        fprintf(stderr, "%u frame%s\n", count, count == 1 ? "" : "s");
        return;
    }
    const double frame = (now() - c->start - c->rest) / (count - 1);
    const double graph = c->graphs / (count - 1);
    fprintf(stderr, "%u frames, %.2f ms each: %.2f ms of passes, %.2f ms beside them\n", count,
            frame * 1e3, graph * 1e3, (frame - graph) * 1e3);
}

/* ---- what hands do ---- */

/* Anything the user waits for that is no frame. */
static void rest_since(struct view *v, double start)
{
    v->costs.rest += now() - start;
}

static bool is_taken(uint32_t number)
{
    static const char *const endings[] = { ".png", ".exr", "-left.exr", "-right.exr" };
    char name[32];
    bool taken = false;
    for (size_t i = 0; i < sizeof(endings) / sizeof(endings[0]); i++) {
        snprintf(name, sizeof(name), "firn-%04u%s", number, endings[i]);
        taken = taken || access(name, F_OK) == 0;
    }
    return taken;
}

/* Nothing that is there is written over. A failure has been logged and ends nothing. */
static void take_screenshot(struct view *v)
{
    char png[32];
    char exr[32];
    const char *const paths[] = { png, exr };
    const double start = now();
    v->shoot = false;
    while (is_taken(++v->shot_number))
        continue;
    snprintf(png, sizeof(png), "firn-%04u.png", v->shot_number);
    snprintf(exr, sizeof(exr), "firn-%04u.exr", v->shot_number);
    (void)!picture_write(v->picture, v->shown, paths, 2, &v->stop);
    rest_since(v, start);
}

static void zoom(struct view *v, float steps)
{
    float nearest;
    float farthest;
    picture_range(v->picture, &nearest, &farthest);
    orbit_zoom(&v->picture->camera, steps, nearest, farthest);
}

/* --split, or the last rung, which is the most exact one; beside it the first. */
static const struct rung *other_rung(const struct view *v)
{
    const struct rung *last = frame_rungs;
    if (v->options->split)
        return v->options->split;
    while (last[1].name)
        last++;
    return v->picture->o.rung == last ? frame_rungs : last;
}

/* A failure has been logged; it stays as it was. */
static void toggle_split(struct view *v)
{
    const double start = now();
    screen_disconnect(&v->screen);
    (void)!picture_split(v->picture, v->picture->o.split ? NULL : other_rung(v));
    show_name(v);
    rest_since(v, start);
}

static void slide(struct view *v, double to)
{
    v->picture->divider = to < 0.0 ? 0.0 : to > 1.0 ? 1.0 : to;
}

static void act(struct view *v, enum view_action action)
{
    struct camera *camera = &v->picture->camera;
    v->changed = true;
    switch (action) {
    case VIEW_LEFT:
        orbit_turn(camera, -key_turn_deg, 0.0f);
        break;
    case VIEW_RIGHT:
        orbit_turn(camera, key_turn_deg, 0.0f);
        break;
    case VIEW_UP:
        orbit_turn(camera, 0.0f, key_turn_deg);
        break;
    case VIEW_DOWN:
        orbit_turn(camera, 0.0f, -key_turn_deg);
        break;
    case VIEW_NEARER:
        zoom(v, 1.0f);
        break;
    case VIEW_FARTHER:
        zoom(v, -1.0f);
        break;
    case VIEW_RESET:
        *camera = v->picture->first_camera;
        break;
    case VIEW_PAUSE:
        v->paused = !v->paused;
        show_name(v);
        break;
    case VIEW_SCREENSHOT:
        v->shoot = true;
        break;
    case VIEW_FULLSCREEN:
        window_fill_screen(&v->window);
        break;
    case VIEW_SPLIT:
        toggle_split(v);
        break;
    case VIEW_DIVIDER_LEFT:
        slide(v, v->picture->divider - key_slide);
        break;
    case VIEW_DIVIDER_RIGHT:
        slide(v, v->picture->divider + key_slide);
        break;
    case VIEW_HELP:
        keys_print(stdout);
        fflush(stdout);
        break;
    case VIEW_QUIT:
        v->quit = true;
        break;
    case VIEW_NOTHING:
    case VIEW_HIDE:
    case VIEW_ACTION_COUNT:
        break;
    }
}

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
        zoom(v, (float)input->wheel);
    if (input->slid)
        slide(v, input->divider);
    v->changed = v->changed || input->redraw || input->slid || input->turn_x != 0.0 ||
                 input->turn_y != 0.0 || input->pan_x != 0.0 || input->pan_y != 0.0 ||
                 input->wheel != 0.0;
}

struct drop {
    struct view *view;
    char *path;
};

static enum status open_file(void *user)
{
    const struct drop *drop = user;
    bool remade;
    return picture_open(&drop->view->picture, drop->path, &remade);
}

/* A file that cannot be used has been logged; what was there stays. */
static void open_dropped(struct view *v)
{
    struct drop drop = { .view = v, .path = window_take_dropped(&v->window) };
    const double start = now();
    if (!drop.path)
        return;
    say(v, "loading");
    screen_disconnect(&v->screen);
    (void)!background_run(&v->window, open_file, &drop);
    free(drop.path);
    v->changed = true;
    show_name(v);
    rest_since(v, start);
}

/* Shaders that were saved count from now on; if they cannot, those before stay. */
static void take_shaders(struct view *v)
{
    const double start = now();
    if (!v->watch || !watch_take(v->watch))
        return;
    screen_disconnect(&v->screen);
    if (picture_remake(v->picture) != STATUS_OK)
        watch_revert(v->watch);
    v->changed = true;
    rest_since(v, start);
}

static void handle(struct view *v)
{
    const struct window_input input = window_take(&v->window);
    drag(v, &input);
    for (uint32_t i = 0; i < input.action_count; i++)
        act(v, input.actions[i]);
    open_dropped(v);
    take_shaders(v);
    v->window.divider = v->picture->o.split ? v->picture->divider : -1.0;
    v->quit = v->quit || window_is_closed(&v->window);
}

/* ---- frames ---- */

/* Lets the scene's time pass, and the program's until a frame is due. False: there is none. */
static bool wait_for_turn(struct view *v, VkExtent2D size)
{
    const struct app_options *o = v->options;
    const double before = v->now;
    const bool counted = o->frame_count != 0;
    v->now = now();
    if (!v->paused && o->time_step <= 0.0 && v->costs.frame_count)
        v->elapsed += v->now - before;
    const bool idle = v->paused && !v->changed && !counted;
    if (size.width != 0 && !idle && v->now >= v->next)
        return true;
    const double wait = size.width == 0 || idle ? idle_seconds : v->next - v->now;
    window_wait(&v->window, wait);
    rest_since(v, v->now);
    return false;
}

/* Window, swapchain, renderer and the plan between them fit each other, or *ready is false. */
static enum status fit(struct view *v, VkExtent2D size, bool *ready)
{
    bool remade;
    const double start = now();
    enum status status = screen_fit(&v->screen, size, &remade);
    *ready = status == STATUS_OK && !v->screen.swapchain.stale;
    if (!*ready || v->screen.exec)
        return status;
    status = picture_resize(v->picture, v->screen.swapchain.extent);
    if (status == STATUS_OK)
        status = screen_connect(&v->screen, picture_left(v->picture), picture_right(v->picture));
    rest_since(v, start);
    return status;
}

/* Of the frame that was seen finished last. */
static double passes_of(struct rg_times times)
{
    uint64_t end = 0;
    for (uint32_t i = 0; i < times.pass_count && times.passes; i++)
        end = times.passes[i].end > end ? times.passes[i].end : end;
    return (double)end * 1e-9;
}

static void count_frame(struct view *v)
{
    struct costs *c = &v->costs;
    const struct picture *p = v->picture;
    const struct app_options *o = v->options;
    if (c->frame_count++ == 0) {
        show_name(v);
        c->start = v->now = now();
        c->rest = 0.0;
    } else {
        c->graphs += passes_of(renderer_times(p->renderer)) +
                     (p->right ? passes_of(renderer_times(p->right)) : 0.0) +
                     passes_of(rg_exec_times(v->screen.exec));
    }
    if (o->time_step > 0.0 && !v->paused)
        v->elapsed += o->time_step;
    if (o->fps_limit)
        v->next = v->now + 1.0 / o->fps_limit;
    v->quit = v->quit || (o->frame_count && c->frame_count >= o->frame_count);
}

static struct renderer_shot shot_now(const struct view *v)
{
    const struct motion_params *motion = settings_of(&v->picture->o.settings, &motion_settings);
    return (struct renderer_shot){
        .camera = v->picture->camera,
        .time = (float)((double)motion->time + v->elapsed),
    };
}

static enum status draw(struct view *v)
{
    bool ready;
    const struct renderer_shot shot = shot_now(v);
    v->shown = shot.time;
    enum status status = screen_begin(&v->screen, &ready);
    if (status != STATUS_OK || !ready)
        return status;
    status = picture_draw(v->picture, &shot);
    if (status == STATUS_OK)
        status = screen_end(&v->screen, picture_line(v->picture));
    v->changed = false;
    return status;
}

static enum status run_frame(struct view *v)
{
    bool ready;
    window_poll(&v->window);
    handle(v);
    const VkExtent2D size = window_size(&v->window);
    if (v->quit || !wait_for_turn(v, size))
        return STATUS_OK;
    enum status status = fit(v, size, &ready);
    if (status == STATUS_OK && ready)
        status = draw(v);
    if (status != STATUS_OK || !ready)
        return status;
    if (v->shoot)
        take_screenshot(v);
    count_frame(v);
    return STATUS_OK;
}

/* All that a first frame waits for: the renderers, and the driver, which compiles when it draws. */
static enum status warm_up(void *user)
{
    struct view *v = user;
    bool ready;
    const struct renderer_shot shot = shot_now(v);
    enum status status = fit(v, v->first_size, &ready);
    if (status == STATUS_OK && ready)
        status = picture_draw(v->picture, &shot);
    if (status == STATUS_OK && ready)
        status = picture_wait(v->picture);
    return status;
}

/* From the window, which is there at once, to the first picture. */
static enum status begin(struct view *v)
{
    const struct app_options *o = v->options;
    char words[200];
    enum status status = picture_can_write(o->split, o->outputs, o->output_count);
    if (status == STATUS_OK && o->watch)
        status = watch_create(&v->watch, o->watch, o->quiet);
    if (status == STATUS_OK)
        status = open_window(v);
    if (status != STATUS_OK)
        return status;
    say(v, "loading the device");
    status = background_run(&v->window, open_device, v);
    if (status != STATUS_OK || window_is_closed(&v->window))
        return status;
    snprintf(words, sizeof(words), "loading %s", o->positionals[0]);
    say(v, words);
    status = background_run(&v->window, load, v);
    if (status != STATUS_OK || window_is_closed(&v->window))
        return status;
    say(v, "loading shaders");
    v->screen.replace = v->watch ? watch_replace : NULL;
    v->screen.replace_user = v->watch;
    v->first_size = window_size(&v->window);
    return background_run(&v->window, warm_up, v);
}

static enum status run(struct view *v)
{
    const struct app_options *o = v->options;
    enum status status = begin(v);
    v->quit = status == STATUS_OK && window_is_closed(&v->window);
    v->now = now();
    while (status == STATUS_OK && !v->quit)
        status = run_frame(v);
    if (status == STATUS_OK && o->output_count && v->costs.frame_count)
        status = picture_write(v->picture, v->shown, o->outputs, o->output_count, &v->stop);
    return status;
}

enum status view_run(const struct app_options *options)
{
    struct view *v = calloc(1, sizeof(*v));
    if (!v) {
        log_error("out of memory");
        return STATUS_TRY_AGAIN;
    }
    v->options = options;
    enum status status = stop_begin(&v->stop);
    if (status == STATUS_OK)
        status = run(v);
    if (status == STATUS_OK)
        report(v);
    finish(v);
    if (status == STATUS_OK && v->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has said why */
    stop_end(&v->stop);
    free(v);
    return status;
}
