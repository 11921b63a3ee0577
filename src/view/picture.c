/* picture.c: loads, draws, changes, writes. */
#include "src/view/picture.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/output.h"
#include "src/app/stop.h"
#include "src/image/file.h"
#include "src/log.h"

static enum status out_of_memory(void)
{
    log_error("out of memory");
    return STATUS_TRY_AGAIN;
}

static char *copy(const char *text)
{
    return text ? strdup(text) : NULL;
}

enum status picture_create(struct picture **picture, struct gpu *gpu,
                           const struct app_options *options)
{
    struct picture *p = calloc(1, sizeof(*p));
    *picture = NULL;
    if (!p)
        return out_of_memory();
    p->gpu = gpu;
    p->o = *options;
    p->o.samples = options->samples ? options->samples : 1;
    p->o.positionals[0] = p->scene_name = copy(options->positionals[0]);
    p->o.environment = p->environment_name = copy(options->environment);
    enum status status = STATUS_OK;
    if (!p->scene_name != !options->positionals[0] || !p->environment_name != !options->environment)
        status = out_of_memory();
    if (status == STATUS_OK)
        status = app_load_scene(&p->scene, &p->o);
    if (status == STATUS_OK)
        status = app_camera(&p->camera, &p->scene, &p->o);
    p->first_camera = p->camera;
    if (status == STATUS_OK)
        *picture = p;
    else
        picture_destroy(p);
    return status;
}

void picture_destroy(struct picture *p)
{
    if (!p)
        return;
    renderer_destroy(p->renderer);
    scene_finish(&p->scene);
    free(p->scene_name);
    free(p->environment_name);
    free(p);
}

/* ---- the renderer ---- */

static struct renderer_params renderer_params(struct picture *p)
{
    return (struct renderer_params){
        .gpu = p->gpu,
        .scene = &p->scene,
        .settings = &p->o.settings,
        .rung = p->o.rung,
        .width = p->o.width,
        .height = p->o.height,
        .sharing = p->o.sharing,
    };
}

/* On failure the one before stays. */
static enum status remake_renderer(struct picture *p)
{
    struct renderer_params params = renderer_params(p);
    struct renderer *renderer;
    params.keep = true;
    params.measured = true;
    enum status status = renderer_create(&renderer, &params);
    if (status != STATUS_OK)
        return status;
    renderer_destroy(p->renderer);
    p->renderer = renderer;
    renderer_measure(renderer, &(struct rg_measure){ .clock = RG_CLOCK_STREAM });
    return STATUS_OK;
}

enum status picture_resize(struct picture *p, VkExtent2D size)
{
    if (p->renderer && p->o.width == size.width && p->o.height == size.height)
        return STATUS_OK;
    renderer_destroy(p->renderer); /* first: both may not fit into memory */
    p->renderer = NULL;
    p->o.width = size.width;
    p->o.height = size.height;
    return remake_renderer(p);
}

/* ---- changes ---- */

/* Takes the place of *picture, which is destroyed, with a renderer of the same size. */
static enum status replace(struct picture **picture, const struct app_options *o, bool keep_camera)
{
    struct picture *next;
    const bool drawn = (*picture)->renderer != NULL;
    enum status status = picture_create(&next, (*picture)->gpu, o);
    if (status == STATUS_OK && drawn)
        status = remake_renderer(next);
    if (status != STATUS_OK) {
        picture_destroy(next);
        return status;
    }
    if (keep_camera) {
        next->camera = (*picture)->camera;
        next->first_camera = (*picture)->first_camera;
    }
    picture_destroy(*picture);
    *picture = next;
    return STATUS_OK;
}

static bool same_frame(const struct app_options *a, const struct app_options *b)
{
    const struct frame_list before = frame_with(a->rung, &a->settings);
    const struct frame_list after = frame_with(b->rung, &b->settings);
    for (size_t i = 0; i < FRAME_TECHNIQUE_COUNT; i++) {
        if (before.techniques[i] != after.techniques[i])
            return false;
    }
    /* a cube that is drawn only once shows the settings it was drawn with */
    return frame_cube_is_dynamic(&a->settings) && frame_cube_is_dynamic(&b->settings);
}

enum status picture_change(struct picture **picture, const struct settings *settings,
                           const struct rung *rung, bool *remade)
{
    struct picture *p = *picture;
    const struct app_options before = p->o;
    struct app_options wanted = p->o;
    *remade = false;
    wanted.settings = *settings;
    wanted.rung = rung;
    wanted.ior_is_set = true; /* whatever it is, it is in the settings */
    if (!app_same_scene(&before, &wanted)) {
        *remade = true;
        return replace(picture, &wanted, true);
    }
    p->o = wanted;
    if (!p->renderer || same_frame(&before, &wanted))
        return STATUS_OK;
    const enum status status = remake_renderer(p);
    *remade = status == STATUS_OK;
    if (status != STATUS_OK)
        p->o = before;
    return status;
}

static bool is_environment(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (!strcmp(dot, ".exr") || !strcmp(dot, ".hdr"));
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

/* ---- files ---- */

static enum status write_file(struct picture *p, const struct output *output, const char *path,
                              const struct render_result *result, struct stop *stop)
{
    void *data = NULL;
    size_t size = 0;
    enum status status =
        output_encode(output, path, result, p->gpu->properties.deviceName, &data, &size);
    if (status == STATUS_OK) {
        stop_hold(stop);
        status = file_write(path, data, size);
        stop_release(stop);
    }
    free(data);
    if (status == STATUS_OK && !p->o.quiet)
        fprintf(stderr, "%s: %ux%u, %u sample%s\n", strcmp(path, "-") ? path : "stdout", p->o.width,
                p->o.height, p->o.samples, p->o.samples > 1 ? "s" : "");
    return status;
}

enum status picture_write(struct picture *p, float time, const char *const *paths,
                          uint32_t path_count, struct stop *stop)
{
    struct renderer_params params = renderer_params(p);
    struct output output = {
        .options = &p->o,
        .scene = &p->scene,
        .shot = { .camera = p->camera, .time = time },
    };
    struct render_result result = { 0 };
    struct renderer *renderer = NULL;
    params.samples = p->o.samples;
    for (uint32_t i = 0; i < path_count; i++) {
        if (output_is_png(paths[i]))
            params.display = true;
        else
            params.linear = true;
    }
    params.layers = params.linear ? p->o.layers : 0;
    enum status status = output_describe(&output);
    if (status == STATUS_OK)
        status = renderer_create(&renderer, &params);
    if (status == STATUS_OK)
        status = renderer_render(renderer, &output.shot, &result, NULL, NULL);
    for (uint32_t i = 0; i < path_count && status == STATUS_OK; i++)
        status = write_file(p, &output, paths[i], &result, stop);
    render_result_finish(&result);
    renderer_destroy(renderer);
    output_finish(&output);
    return status;
}
