/* renderer.c: renders views of a scene, and converts their layers to buffers of the caller. */
#include <stdlib.h>
#include <string.h>
#include "src/base/suggest.h"
#include "src/base/text_stream.h"
#include "src/lib/lib.h"
#include "src/render/frame/output_layers.h"
#include "src/setup/aov_to_png.h"

/* ---- creation ---- */

static enum status find_layer(const char *name, uint32_t *index)
{
    struct suggest suggest = { .word = name ? name : "" };
    char hint[SUGGEST_HINT_SIZE];
    for (*index = 0; lib_layer(*index) && name; ++*index) {
        if (!strcmp(lib_layer(*index)->name, name))
            return STATUS_OK;
        suggest_offer(&suggest, lib_layer(*index)->name);
    }
    log_error("unknown layer '%s'%s (firn list layers)", suggest.word,
              suggest_hint(&suggest, hint));
    return STATUS_USAGE;
}

static enum status add_layers(firn_renderer *r, const struct firn_renderer_options *options)
{
    enum status status = lib_require(options->layers, "options.layers");
    if (status == STATUS_OK && !options->layer_count) {
        log_error("options.layer_count: expected at least one layer, such as beauty");
        status = STATUS_USAGE;
    }
    for (size_t i = 0; i < options->layer_count && status == STATUS_OK; i++) {
        uint32_t index;
        status = find_layer(options->layers[i], &index);
        if (status != STATUS_OK)
            return status;
        r->has_beauty = r->has_beauty || index == 0;
        r->has_display = r->has_display || index == 1;
        if (index > 1)
            r->layers |= layer_image_bit(lib_layer(index));
    }
    return status;
}

static enum status check_options(const struct firn_renderer_options *o)
{
    if (o->width && o->height && o->width <= 16384 && o->height <= 16384 && o->samples <= 65536)
        return STATUS_OK;
    log_error("options: expected a size of 1x1 to 16384x16384 and at most 65536 samples, got %ux%u "
              "and %u",
              o->width, o->height, o->samples);
    return STATUS_USAGE;
}

static void init(firn_renderer *r, firn_scene *scene, const struct firn_renderer_options *options)
{
    r->scene = scene;
    r->next = scene->renderers;
    scene->renderers = r;
    scene->refs++;
    r->width = options->width;
    r->height = options->height;
    r->samples = options->samples;
    mutex_init(&r->lock);
    condition_init(&r->changed);
    r->session = (struct image_session){
        .image = &r->image,
        .scene = &scene->session,
        .gpu = &scene->device->gpu,
        .gpu_params = &scene->device->gpu_params,
        .layers = r->layers,
        .linear = r->has_beauty,
        .display = r->has_display,
        .resolved = r->has_display,
    };
}

static void release(firn_renderer *r)
{
    firn_renderer **link = &r->scene->renderers;
    lib_worker_end(r);
    while (*link != r)
        link = &(*link)->next;
    *link = r->next;
    image_session_close(&r->session);
    free(r->plan);
    mutex_finish(&r->lock);
    condition_finish(&r->changed);
    lib_release_scene(r->scene);
    free(r);
}

static enum status create(firn_scene *scene, const struct firn_renderer_options *given,
                          firn_renderer **created)
{
    struct firn_renderer_options options;
    struct renderer_shot shot;
    const struct firn_camera camera = { .size = sizeof(camera) };
    enum status status = lib_read(&options, sizeof(options), given, "options");
    if (status == STATUS_OK)
        status = check_options(&options);
    firn_renderer *r = status == STATUS_OK ? calloc(1, sizeof(*r)) : NULL;
    if (!r)
        return status == STATUS_OK ? log_out_of_memory(NULL) : status;
    status = add_layers(r, &options);
    if (status != STATUS_OK) {
        free(r);
        return status;
    }
    init(r, scene, &options);
    status = lib_renderer_aim(r, &camera, &shot);
    if (status == STATUS_OK)
        status = image_session_open(&r->session, &r->session.camera);
    if (status == STATUS_OK)
        *created = r;
    else
        release(r);
    return status;
}

firn_status firn_renderer_create(firn_scene *scene, const struct firn_renderer_options *options,
                                 firn_renderer **renderer)
{
    struct lib_call call;
    if (renderer)
        *renderer = NULL;
    if (!lib_enter(&call, scene ? scene->device : NULL, true))
        return scene ? FIRN_FAILED : FIRN_USAGE;
    enum status status = lib_require(renderer, "renderer");
    if (status == STATUS_OK)
        status = create(scene, options, renderer);
    return lib_leave(&call, status);
}

void firn_renderer_close(firn_renderer *renderer)
{
    struct lib_call call;
    if (!renderer || !lib_is_own(renderer->scene->device))
        return;
    firn_cancel(renderer);
    if (!lib_enter(&call, renderer->scene->device, true))
        return;
    release(renderer);
    (void)lib_leave(&call, STATUS_OK);
}

static enum status make_plan(firn_renderer *r, const char **html)
{
    enum status status = lib_require(html, "html");
    if (status == STATUS_OK && !r->session.renderer) {
        log_error("the path tracer (refraction=reference) has no plan");
        status = STATUS_USAGE;
    }
    if (status != STATUS_OK)
        return status;
    struct text_stream stream;
    free(r->plan);
    r->plan = NULL;
    FILE *out = text_stream_open(&stream);
    if (out)
        rg_dump_html(renderer_frame(r->session.renderer), out);
    r->plan = text_stream_close(&stream, NULL);
    if (!r->plan)
        return log_out_of_memory("plan");
    *html = r->plan;
    return STATUS_OK;
}

firn_status firn_renderer_plan(firn_renderer *renderer, const char **html)
{
    struct lib_call call;
    const struct firn_camera camera = { .size = sizeof(camera) };
    struct renderer_shot shot;
    if (html)
        *html = NULL;
    if (!lib_enter(&call, renderer ? renderer->scene->device : NULL, true))
        return renderer ? FIRN_FAILED : FIRN_USAGE;
    enum status status = lib_renderer_aim(renderer, &camera, &shot);
    if (status == STATUS_OK)
        status = image_session_open(&renderer->session, &renderer->session.camera);
    if (status == STATUS_OK)
        status = make_plan(renderer, html);
    return lib_leave(&call, status);
}

/* ---- views ---- */

firn_status firn_render(firn_renderer *renderer, const struct firn_camera *camera,
                        const struct firn_buffer *buffers, size_t count, firn_progress_fn *progress,
                        void *user)
{
    struct lib_call call;
    struct firn_camera copied;
    if (!lib_enter(&call, renderer ? renderer->scene->device : NULL, true))
        return renderer ? FIRN_FAILED : FIRN_USAGE;
    struct render_result *result = &renderer->jobs[0].result; /* no views are in flight below */
    enum status status = lib_camera_read(&copied, camera);
    if (status == STATUS_OK)
        status = lib_buffers_check(renderer, buffers, count);
    if (status == STATUS_OK && renderer->submitted > renderer->fetched) {
        log_error("views of the renderer are in flight: fetch them first");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK) {
        atomic_store(&renderer->is_cancelled, false);
        status = lib_draw(renderer, &copied, result, progress, user);
    }
    const struct lib_shown shown = lib_shown_of(renderer);
    if (status == STATUS_OK)
        status = lib_buffers_write(renderer, buffers, count, &shown, result);
    return lib_leave(&call, status);
}

void firn_cancel(firn_renderer *renderer)
{
    if (!renderer || !lib_is_own(renderer->scene->device))
        return;
    mutex_lock(&renderer->lock);
    renderer->cancelled = renderer->submitted;
    atomic_store(&renderer->is_cancelled, true);
    mutex_unlock(&renderer->lock);
}

static enum status convert(firn_renderer *renderer, const struct firn_camera *from,
                           struct firn_camera *to)
{
    struct firn_camera source, result;
    struct renderer_shot shot;
    enum status status = lib_camera_read(&source, from);
    if (status == STATUS_OK)
        status = lib_read(&result, sizeof(result), to, "to");
    if (status == STATUS_OK &&
        (result.kind == FIRN_CAMERA_SCENE || result.kind > FIRN_CAMERA_OPENGL)) {
        log_error(
            "to.kind: expected FIRN_CAMERA_LOOK_AT, FIRN_CAMERA_OPENCV or FIRN_CAMERA_OPENGL");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = lib_renderer_aim(renderer, &source, &shot);
    if (status == STATUS_OK && shot.camera.height > 0.0f) {
        log_error("camera: it is orthographic and has no focal length");
        status = STATUS_USAGE;
    }
    if (status != STATUS_OK)
        return status;
    lib_camera_describe(&result, &source, &shot.camera, renderer);
    return lib_write(to, &result, sizeof(result), "to");
}

firn_status firn_camera_convert(firn_renderer *renderer, const struct firn_camera *from,
                                struct firn_camera *to)
{
    struct lib_call call;
    if (!lib_enter(&call, renderer ? renderer->scene->device : NULL, true))
        return renderer ? FIRN_FAILED : FIRN_USAGE;
    return lib_leave(&call, convert(renderer, from, to));
}
