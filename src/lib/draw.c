/* draw.c: draws a view: updates the renderer for changes of its scene, then renders. */
#include "src/lib/lib.h"
#include "src/settings/scene_settings.h"
#include "src/setup/image_output.h"
#include "src/tech/refract/cpu_reference_settings.h"

/* Copies the scene's options, and makes the choices that depend on the image. */
static enum status refresh(firn_renderer *r)
{
    firn_scene *scene = r->scene;
    const bool is_first = !r->version;
    enum status status = lib_scene_update(scene);
    if (status != STATUS_OK || r->version == scene->version)
        return status;
    struct setup_image *image = &r->image;
    *image = scene->image;
    if (r->samples)
        status = lib_scene_image(scene, r->samples, image);
    image->width = r->width;
    image->height = r->height;
    image->layers = r->layers;
    image->scene.quiet = image->scene.quiet || !is_first;
    r->session.quiet = image->scene.quiet;
    r->session.linear = r->has_beauty || image->is_adaptive; /* adaptive sampling reads it */
    r->session.skips_exposure = !r->has_display && !image->is_adaptive;
    if (status == STATUS_OK)
        status = image_session_choose(&r->session);
    if (status == STATUS_OK)
        status = output_check_tiles(image, &(struct setup_outputs){ 0 });
    if (status != STATUS_OK)
        return status;
    image_session_change(&r->session);
    r->version = scene->version;
    return STATUS_OK;
}

/* Logs an error and returns STATUS_USAGE if the renderer needs a Vulkan device that is not open. */
static enum status check_device(const firn_renderer *r)
{
    if (r->scene->device->has_gpu || r->image.refraction == &cpu_reference_settings)
        return STATUS_OK;
    log_error("the device was opened without a Vulkan device: only refraction=reference can draw");
    return STATUS_NO_DEVICE;
}

enum status lib_renderer_aim(firn_renderer *r, const struct firn_camera *camera,
                             struct renderer_shot *shot)
{
    struct session_scene *session = &r->scene->session;
    enum status status = refresh(r);
    if (status == STATUS_OK)
        status = check_device(r);
    if (status != STATUS_OK)
        return status;
    const struct motion_params *motion = settings_of(&r->image.scene.settings, &motion_settings);
    const bool is_own = camera->kind == FIRN_CAMERA_SCENE;
    *shot = (struct renderer_shot){
        .camera = r->session.camera,
        .time = camera->has_time ? (float)camera->time : motion->time,
    };
    if (session->scene.is_animated &&
        (session->scene.time < shot->time || session->scene.time > shot->time))
        lib_scene_close_sessions(r->scene);
    status = image_session_pose(&r->session, shot, is_own);
    return status == STATUS_OK && !is_own ? lib_camera_of(&shot->camera, camera, r) : status;
}

struct progress {
    firn_renderer *renderer;
    firn_progress_fn *fn;
    void *user;
};

static bool show_progress(void *user, uint32_t done, uint32_t all)
{
    const struct progress *progress = user;
    if (progress->fn && progress->fn(progress->user, done, all))
        atomic_store(&progress->renderer->is_cancelled, true);
    return !atomic_load(&progress->renderer->is_cancelled);
}

enum status lib_draw(firn_renderer *r, const struct firn_camera *camera,
                     struct render_result *result, firn_progress_fn *fn, void *user)
{
    struct progress progress = { r, fn, user };
    struct renderer_shot shot;
    enum status status = lib_renderer_aim(r, camera, &shot);
    if (status == STATUS_OK)
        status = image_session_open(
            &r->session, camera->kind == FIRN_CAMERA_SCENE ? &r->session.camera : &shot.camera);
    if (status == STATUS_OK && !atomic_load(&r->is_cancelled))
        status = image_session_draw(&r->session, &shot, result, show_progress, &progress);
    if (atomic_load(&r->is_cancelled) && (status == STATUS_OK || status == STATUS_FAILED)) {
        render_result_finish(result);
        log_error("cancelled");
        status = LIB_CANCELLED;
    }
    return status;
}
