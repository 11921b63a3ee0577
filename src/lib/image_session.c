/* image_session.c: camera, exposure, pose and renderer of the images of a scene. */
#include "src/lib/image_session.h"
#include <stdlib.h>
#include "src/base/log.h"
#include "src/base/thread.h"
#include "src/lab/reference/reference_aov_table.h"
#include "src/render/lavapipe_tuning.h"
#include "src/render/make_frame_request.h"
#include "src/setup/aov_to_png.h"
#include "src/setup/object_id_names.h"
#include "src/setup/previous_pose.h"
#include "src/tech/refract/cpu_reference_settings.h"

struct filling {
    struct image_session *session;
    struct log_sink *sink; /* log sink of the waiting thread */
    const char *missing;   /* result of setup_fill_scene() */
};

bool image_session_has_layer(const struct technique *refraction, const struct frame_layer *layer)
{
    if (layer->is_traced)
        return reference_is_built();
    if (refraction == &cpu_reference_settings)
        return reference_has_layer(layer);
    return layer->image && (!layer->needs_bvh || refraction->refraction.traces_bvh);
}

/* Refuses layers that the refraction model lacks; with --aov all, removes them. */
static enum status check_layers(struct image_session *s)
{
    const uint64_t layers = s->image->layers | layer_image_bit(s->image->show);
    for (uint32_t i = 0; techniques_layer(i); i++) {
        const struct frame_layer *layer = techniques_layer(i);
        const uint64_t bit = UINT64_C(1) << i;
        if (!(layers & bit) || image_session_has_layer(s->image->refraction, layer))
            continue;
        if (!s->image->all_layers) {
            log_error("layer '%s' is not available with refraction model %s (firn list layers)",
                      layer->name, s->image->refraction->refraction.name);
            return STATUS_USAGE;
        }
        s->image->layers &= ~bit;
    }
    return STATUS_OK;
}

enum status image_session_choose(struct image_session *s)
{
    enum status status = setup_camera(&s->camera, &s->scene->scene, s->image);
    if (status == STATUS_OK && !s->skips_exposure)
        status = setup_choose_exposure(s->image, &s->scene->scene, &s->camera);
    if (status == STATUS_OK)
        setup_choose_refraction(s->image, &s->scene->scene, &s->camera);
    return status == STATUS_OK ? check_layers(s) : status;
}

enum status image_session_pose(struct image_session *s, struct renderer_shot *shot,
                               bool sets_camera)
{
    struct scene *scene = &s->scene->scene;
    struct previous_pose previous;
    bool is_changed = false;
    if (!scene->is_animated)
        return STATUS_OK;
    if (scene->time < shot->time || scene->time > shot->time) {
        image_session_close(s);
        s->scene->pose++;
    }
    enum status status = previous_pose_find(&previous, &shot->earlier, scene, s->image, shot->time);
    if (status == STATUS_OK)
        status = setup_pose_scene(scene, &s->image->scene, shot->time, &is_changed);
    previous_pose_move_to(&previous, scene);
    s->scene->is_filled = s->scene->is_filled || (status == STATUS_OK && is_changed);
    if (status == STATUS_OK && sets_camera)
        status = setup_camera(&shot->camera, scene, s->image);
    return status;
}

static void fill(void *user)
{
    struct filling *filling = user;
    struct session_scene *scene = filling->session->scene;
    log_set_sink(filling->sink);
    filling->missing = setup_fill_scene(&scene->scene, &filling->session->image->scene);
}

/* Loads textures and meshes unless they are loaded. */
static enum status fill_scene(struct image_session *s)
{
    struct filling filling = { s, log_get_sink(), NULL };
    if (!s->scene->is_filled)
        fill(&filling);
    s->scene->is_filled = !filling.missing;
    return filling.missing ? setup_log_fill_failure(filling.missing) : STATUS_OK;
}

/* Opens the device while another thread loads textures and meshes. If both fail, logs and returns
 * only the device's failure. */
static enum status open_device(struct image_session *s)
{
    struct filling filling = { s, log_get_sink(), NULL };
    struct thread thread;
    if (s->gpu->device)
        return fill_scene(s);
    if (s->prefers_start)
        lavapipe_tuning_prefer_start();
    const bool is_beside = !s->scene->is_filled && thread_start(&thread, fill, &filling);
    const enum status status = gpu_create(s->gpu, s->gpu_params);
    if (is_beside)
        thread_join(&thread);
    else if (status == STATUS_OK && !s->scene->is_filled)
        fill(&filling);
    s->scene->is_filled = true;
    return status == STATUS_OK && filling.missing ? setup_log_fill_failure(filling.missing)
                                                  : status;
}

static enum status open_reference(struct image_session *s, const struct renderer_params *params)
{
    const struct reference_request request = {
        .scene = params->scene,
        .settings = params->settings,
        .width = params->width,
        .height = params->height,
        .samples = params->samples,
        .noise = s->noise,
        .seconds = s->seconds,
        .filter = params->filter,
        .layers = params->layers,
        .linear = params->linear,
        .display = params->display,
        .resolved = params->resolved,
    };
    char names[REFERENCE_NAMES_SIZE];
    enum status status = fill_scene(s);
    if (status == STATUS_OK)
        status = reference_create(&s->reference, &request);
    if (status == STATUS_OK && !s->quiet && !s->has_warned &&
        reference_unsupported(params->settings, names, sizeof(names)))
        log_warning("--refraction reference: draws the scene without %s", names);
    return status;
}

static enum status create(struct image_session *s, const struct renderer_params *params)
{
    enum status status = STATUS_OK;
    s->pose = s->scene->pose;
    if (params->refraction == &cpu_reference_settings)
        return open_reference(s, params);
    const bool was_open = s->gpu->device;
    status = open_device(s);
    if (status == STATUS_OK && !(was_open && s->has_warned))
        setup_check_rays(params->settings, s->gpu);
    return status == STATUS_OK ? renderer_create(&s->renderer, params) : status;
}

static struct renderer_params params_for(struct image_session *s, const struct camera *camera)
{
    struct renderer_params params = setup_renderer_params(s->image, s->gpu, &s->scene->scene);
    params.samples = s->image->samples;
    params.layers = s->layers & ~ray_layer_tracer_mask(s->layers);
    params.linear = s->linear;
    params.display = s->display;
    params.resolved = s->resolved;
    renderer_set_camera(&params, camera);
    return params;
}

void image_session_change(struct image_session *s)
{
    s->is_outdated = true;
}

/* Returns true if the present renderer or path tracer can draw with the parameters. */
static bool fits(const struct image_session *s, const struct renderer_params *params)
{
    if (s->pose != s->scene->pose || s->is_outdated)
        return false;
    return s->reference || (s->renderer && s->is_orthographic == params->is_orthographic &&
                            s->is_wide == renderer_draws_beyond_image(params));
}

/* Adapts the renderer if it fits the present pose. Otherwise closes the session. */
static enum status change(struct image_session *s, const struct renderer_params *params)
{
    const bool is_reference = params->refraction == &cpu_reference_settings;
    enum status status = STATUS_TRY_AGAIN;
    if (s->renderer && s->pose == s->scene->pose && !is_reference)
        status = renderer_change(s->renderer, params);
    if (status != STATUS_OK)
        image_session_close(s);
    return status == STATUS_TRY_AGAIN ? STATUS_OK : status;
}

enum status image_session_open(struct image_session *s, const struct camera *camera)
{
    const struct renderer_params params = params_for(s, camera);
    if (fits(s, &params))
        return STATUS_OK;
    ray_layer_tracer_destroy(s->ray_layers);
    s->ray_layers = NULL;
    enum status status = change(s, &params);
    if (status == STATUS_OK && !s->renderer)
        status = create(s, &params);
    s->is_outdated = status != STATUS_OK;
    s->is_wide = s->renderer && renderer_draws_beyond_image(&params);
    s->is_orthographic = params.is_orthographic;
    s->has_warned = true;
    return status;
}

enum status image_session_draw(struct image_session *s, const struct renderer_shot *shot,
                               struct render_result *result, renderer_progress_fn *progress,
                               void *user)
{
    enum status status;
    if (s->reference) {
        render_result_finish(result);
        status = reference_render(s->reference, shot, result, progress, user);
    } else {
        status = renderer_render_again(s->renderer, shot, result, progress, user);
    }
    return status == STATUS_OK ? image_session_trace_layers(s, shot, result) : status;
}

static enum status create_tracer(struct image_session *s, const struct camera *camera)
{
    struct renderer_params params = params_for(s, camera);
    char *objects = object_names(&s->scene->scene), *materials = material_names(&s->scene->scene);
    params.layers = s->layers;
    const enum status status =
        objects && materials ? ray_layer_tracer_create(&s->ray_layers, &params, objects, materials)
                             : log_out_of_memory("names");
    free(objects);
    free(materials);
    return status;
}

enum status image_session_trace_layers(struct image_session *s, const struct renderer_shot *shot,
                                       struct render_result *result)
{
    enum status status = STATUS_OK;
    if (!ray_layer_tracer_mask(s->layers))
        return STATUS_OK;
    if (!s->ray_layers)
        status = create_tracer(s, &shot->camera);
    if (status == STATUS_OK)
        status = ray_layer_tracer_draw(s->ray_layers, shot, &result->image);
    if (status != STATUS_OK)
        render_result_finish(result);
    return status;
}

const char *image_session_device(const struct image_session *s)
{
    return s->reference ? reference_device(s->reference) : s->gpu->properties.deviceName;
}

void image_session_close(struct image_session *s)
{
    renderer_destroy(s->renderer);
    reference_destroy(s->reference);
    ray_layer_tracer_destroy(s->ray_layers);
    s->renderer = NULL;
    s->reference = NULL;
    s->ray_layers = NULL;
}
