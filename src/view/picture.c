/* picture.c: loads, draws, changes. */
#include "src/view/picture.h"
#include <stdlib.h>
#include <string.h>
#include "shaders/present.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/frame/list.h"
#include "src/settings/scene_settings.h"
#include "src/view/watch.h"

static char *copy(const char *text)
{
    return text ? strdup(text) : NULL;
}

enum status picture_create(struct picture **picture, struct gpu *gpu,
                           const struct app_options *options, struct watch *watch)
{
    struct picture *p = calloc(1, sizeof(*p));
    *picture = NULL;
    if (!p)
        return log_out_of_memory(NULL);
    p->gpu = gpu;
    p->watch = watch;
    p->divider = 0.5;
    p->o = *options;
    p->o.samples = options->samples ? options->samples : 1;
    p->o.positionals[0] = p->scene_name = copy(options->positionals[0]);
    p->o.environment = p->environment_name = copy(options->environment);
    enum status status = STATUS_OK;
    if (!p->scene_name != !options->positionals[0] || !p->environment_name != !options->environment)
        status = log_out_of_memory(NULL);
    if (status == STATUS_OK)
        status = app_load_scene(&p->scene, &p->o);
    if (status == STATUS_OK)
        status = app_camera(&p->camera, &p->scene, &p->o);
    p->first_camera = p->camera;
    if (status == STATUS_OK)
        status = picture_upload(p);
    if (status == STATUS_OK)
        *picture = p;
    else
        picture_destroy(p);
    return status;
}

static void forget_renderers(struct picture *p)
{
    renderer_destroy(p->renderer);
    renderer_destroy(p->right);
    p->renderer = NULL;
    p->right = NULL;
}

void picture_leave_device(struct picture *p)
{
    if (!p)
        return;
    forget_renderers(p);
    uploaded_scene_finish(&p->uploaded, p->gpu);
}

enum status picture_upload(struct picture *p)
{
    return uploaded_scene_init(&p->uploaded, p->gpu, &p->scene);
}

void picture_destroy(struct picture *p)
{
    if (!p)
        return;
    picture_leave_device(p);
    scene_finish(&p->scene);
    free(p->scene_name);
    free(p->environment_name);
    free(p);
}

/* ---- the renderer ---- */

struct renderer_params picture_params(struct picture *p)
{
    return (struct renderer_params){
        .gpu = p->gpu,
        .scene = &p->scene,
        .uploaded = &p->uploaded,
        .settings = &p->o.settings,
        .rung = p->o.rung,
        .width = p->o.width,
        .height = p->o.height,
        .sharing = p->o.sharing,
        .replace = p->watch ? watch_replace : NULL,
        .replace_user = p->watch,
    };
}

static enum status make_renderer(struct picture *p, const struct technique *rung,
                                 struct renderer **renderer)
{
    struct renderer_params params = picture_params(p);
    params.rung = rung;
    params.keep = true;
    params.measured = true;
    const enum status status = renderer_create(renderer, &params);
    if (status == STATUS_OK)
        renderer_measure(*renderer, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
    return status;
}

/* On failure those before stay. */
static enum status make_renderers(struct picture *p)
{
    struct renderer *left = NULL;
    struct renderer *right = NULL;
    enum status status = make_renderer(p, p->o.rung, &left);
    if (status == STATUS_OK && p->o.split)
        status = make_renderer(p, p->o.split, &right);
    if (status != STATUS_OK) {
        renderer_destroy(left);
        return status;
    }
    forget_renderers(p);
    p->renderer = left;
    p->right = right;
    return STATUS_OK;
}

enum status picture_remake(struct picture *p)
{
    return p->renderer ? make_renderers(p) : STATUS_OK;
}

enum status picture_resize(struct picture *p, VkExtent2D size)
{
    if (p->renderer && p->o.width == size.width && p->o.height == size.height)
        return STATUS_OK;
    forget_renderers(p); /* first: both sizes may not fit into memory */
    p->o.width = size.width;
    p->o.height = size.height;
    return make_renderers(p);
}

enum status picture_split(struct picture *p, const struct technique *rung)
{
    const struct technique *before = p->o.split;
    p->o.split = rung;
    const enum status status = picture_remake(p);
    if (status != STATUS_OK)
        p->o.split = before;
    return status;
}

/* ---- frames ---- */

enum status picture_draw(struct picture *p, const struct renderer_shot *shot)
{
    enum status status = renderer_draw(p->renderer, shot);
    if (status == STATUS_OK && p->right)
        status = renderer_draw(p->right, shot);
    return status;
}

enum status picture_wait(struct picture *p)
{
    enum status status = renderer_wait(p->renderer);
    if (status == STATUS_OK && p->right)
        status = renderer_wait(p->right);
    return status;
}

VkImage picture_left(const struct picture *p)
{
    return renderer_picture(p->renderer);
}

VkImage picture_right(const struct picture *p)
{
    return renderer_picture(p->right ? p->right : p->renderer);
}

uint32_t picture_line(const struct picture *p)
{
    return p->o.split ? (uint32_t)(p->divider * p->o.width + 0.5) : PRESENT_NO_LINE;
}

/* ---- changes ---- */

/* Takes the place of *picture, which is destroyed, with a renderer of the same size. */
static enum status replace(struct picture **picture, const struct app_options *o, bool keep_camera)
{
    struct picture *next;
    const bool drawn = (*picture)->renderer != NULL;
    enum status status = picture_create(&next, (*picture)->gpu, o, (*picture)->watch);
    if (status == STATUS_OK && drawn)
        status = make_renderers(next);
    if (status != STATUS_OK) {
        picture_destroy(next);
        return status;
    }
    if (keep_camera) {
        next->camera = (*picture)->camera;
        next->first_camera = (*picture)->first_camera;
    }
    next->divider = (*picture)->divider;
    picture_destroy(*picture);
    *picture = next;
    return STATUS_OK;
}

/* Whether the renderers of one draw the other, too. */
static bool same_frame(const struct picture *p, const struct app_options *a,
                       const struct app_options *b)
{
    if (settings_changed(&a->settings, &b->settings) >= SETTING_AFFECTS_PLAN || a->rung != b->rung)
        return false;
    /* a cube that is drawn only once shows the settings it was drawn with */
    return frame_draws_cube(&a->settings, &p->scene) && frame_draws_cube(&b->settings, &p->scene);
}

enum status picture_change(struct picture **picture, const struct settings *settings,
                           const struct technique *rung, bool *remade)
{
    struct picture *p = *picture;
    const struct app_options before = p->o;
    struct app_options wanted = p->o;
    *remade = false;
    wanted.settings = *settings;
    wanted.rung = rung;
    wanted.ior_is_set = true; /* whatever it is, it is in the settings */
    if (settings_changed(&before.settings, settings) == SETTING_AFFECTS_SCENE) {
        *remade = true;
        return replace(picture, &wanted, true);
    }
    p->o = wanted;
    if (!p->renderer || same_frame(p, &before, &wanted))
        return STATUS_OK;
    const enum status status = picture_remake(p);
    *remade = status == STATUS_OK;
    if (status != STATUS_OK)
        p->o = before;
    return status;
}

static bool is_environment(const char *path)
{
    return path_ends_in(path, ".exr") || path_ends_in(path, ".hdr");
}

enum status picture_open(struct picture **picture, const char *path, bool *remade)
{
    const bool environment = is_environment(path);
    struct app_options o = (*picture)->o;
    if (environment) {
        o.environment = path;
        o.has_background = false;
    } else {
        o.positionals[0] = path;
        o.has_eye = o.has_target = o.has_orbit = false; /* those were of the object before */
    }
    const enum status status = replace(picture, &o, environment);
    *remade = status == STATUS_OK;
    return status;
}

void picture_range(const struct picture *p, float *nearest, float *farthest)
{
    const float size = box_diagonal(p->scene.box);
    *nearest = 0.05f * size;
    *farthest = 50.0f * size;
}
