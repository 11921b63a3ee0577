/* choose_camera.c: chooses the camera from --camera, --eye, --orbit or the model. */
#include <cglm/struct.h>
#include <math.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/suggest.h"
#include "src/scene/world_position.h"
#include "src/setup/setup.h"

static const float default_fov_deg = 45.0f;

/* ---- --camera ---- */

static enum status refuse_name(const struct model *model, const struct setup_image *p)
{
    struct suggest suggest = { .word = p->camera };
    struct suggest_list list = { 0 };
    char hint[SUGGEST_HINT_SIZE];
    for (uint32_t i = 0; i < model->camera_count; i++) {
        suggest_offer(&suggest, model->cameras[i].name);
        suggest_list_add(&list, model->cameras[i].name);
    }
    if (list.count)
        log_error("--camera %s: no camera in %s has this name or number%s; it has %s", p->camera,
                  p->scene.name, suggest_hint(&suggest, hint), list.text);
    else
        log_error("--camera %s: %s has no cameras; place one with --orbit or --eye", p->camera,
                  p->scene.name);
    return STATUS_USAGE;
}

/* Finds the camera of --camera by name or number. Cameras of --surroundings are not considered. */
static enum status find_named(const struct model_camera **found, const struct model *model,
                              const struct setup_image *p)
{
    const struct model_camera *named = NULL;
    uint32_t number;
    if (p->camera[0] && suggest_number(p->camera, model->camera_count, &number))
        named = &model->cameras[number];
    for (uint32_t i = model->camera_count; i-- > 0 && p->camera[0];) {
        if (!strcmp(model->cameras[i].name, p->camera))
            named = &model->cameras[i];
    }
    if (!named)
        return refuse_name(model, p);
    if (named->kind == MODEL_ORTHOGRAPHIC && p->fov_deg > 0.0f) {
        log_error("--fov conflicts with --camera %s: the camera is orthographic, so it has no "
                  "field of view; leave out --fov",
                  p->camera);
        return STATUS_USAGE;
    }
    *found = named;
    return STATUS_OK;
}

static void reach(const struct mesh *mesh, vec3s center, float *radius)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        *radius = fmaxf(*radius, glms_vec3_distance(mesh->vertices[i].position, center));
}

/* Returns a camera of the model file. The depth range of an orthographic camera is large enough for
 * rotating objects and for a camera at twice the distance from the scene. */
static struct camera camera_of(const struct model_camera *m, const struct scene *scene)
{
    struct camera camera = m->camera;
    if (m->kind == MODEL_ORTHOGRAPHIC) {
        const vec3s center = box_center(scene->box);
        float radius = m->height;
        reach(&scene->model.object, center, &radius);
        reach(&scene->model.surroundings, center, &radius);
        camera.height = m->height;
        camera.depth = 2.0f * (glms_vec3_distance(camera.eye, center) + radius);
    }
    return camera;
}

/* ---- of an image ---- */

/* Returns the camera that frames a model file, at any rotation if a rotation speed is stated. */
static struct camera frame_model(const struct scene *scene, const struct setup_image *p,
                                 const vec3s *target)
{
    const struct setting *rotation = settings_find("motion.ice");
    const struct settings *settings = &p->scene.settings;
    const struct framing_view view = {
        .fov_deg = p->fov_deg,
        .aspect = (float)p->width / (float)p->height,
        .rotates = settings_source(settings, rotation) >= SETTING_PRESET &&
                   fabs(settings_get(settings, rotation)) > 0.0,
        .target = p->target.is_given ? target : NULL,
    };
    return framing_camera(&scene->framing, &view);
}

/* If the image is narrower than a square and than `aspect`, the aspect ratio of a file's camera,
 * enlarges the field of view until the image shows the width of that camera's view, or of a square
 * view if this is narrower. */
static void fit_width(struct camera *camera, float aspect, const struct setup_image *p)
{
    const float least = aspect > 0.0f && aspect < 1.0f ? aspect : 1.0f;
    const float factor = least * (float)p->height / (float)p->width;
    if (!(factor > 1.0f))
        return;
    camera->fov_deg = glm_deg(2.0f * atanf(factor * tanf(glm_rad(camera->fov_deg) / 2.0f)));
    camera->height *= factor;
}

static struct camera choose(const struct scene *scene, const struct setup_image *p,
                            const struct camera *model_camera)
{
    const vec3s center = box_center(scene->framing_box);
    const struct model *model = &scene->model;
    const vec3s target =
        p->target.is_given ? world_position_relative(model, p->target.value) : center;
    const float fov = p->fov_deg > 0.0f ? p->fov_deg : default_fov_deg;
    if (p->eye.is_given)
        return (struct camera){ .eye = world_position_relative(model, p->eye.value),
                                .target = target,
                                .fov_deg = fov };
    if (model_camera && !p->orbit.is_given) {
        struct camera camera = *model_camera;
        camera.fov_deg = p->fov_deg > 0.0f ? fov : camera.fov_deg;
        camera.target = p->target.is_given ? target : camera.target;
        return camera;
    }
    if (scene->framing.count && !p->orbit.is_given)
        return frame_model(scene, p, &target);
    float distance =
        camera_framing_distance(box_diagonal(scene->framing_box), fov, p->width, p->height);
    if (!(distance > 0.0f)) /* a point, or empty */
        distance = 1.0f;
    const vec3s orbit = p->orbit.is_given ? p->orbit.value : (vec3s){ { 28.0f, 9.0f, distance } };
    return camera_orbit(orbit.x, orbit.y, orbit.z, target, fov);
}

/* Checks that at most one option sets the camera position. */
static enum status check_conflicts(const struct setup_image *p)
{
    const char *first = p->camera ? "camera" : "eye";
    const char *second = p->orbit.is_given ? "orbit" : "eye";
    if (p->camera ? !p->eye.is_given && !p->orbit.is_given : !p->eye.is_given || !p->orbit.is_given)
        return STATUS_OK;
    log_error("--%s conflicts with --%s: choose one camera position", first, second);
    return STATUS_USAGE;
}

enum status setup_camera(struct camera *camera, const struct scene *scene,
                         const struct setup_image *p)
{
    const struct model *model = &scene->model;
    const struct model_camera *named = model->camera_count ? &model->cameras[0] : NULL;
    struct camera model_camera = model->camera;
    enum status status = check_conflicts(p);
    if (status == STATUS_OK && p->camera)
        status = find_named(&named, model, p);
    if (status != STATUS_OK)
        return status;
    const bool is_named = p->camera || (named && !model->has_camera && !(p->fov_deg > 0.0f));
    if (is_named)
        model_camera = camera_of(named, scene);
    if (!(p->fov_deg > 0.0f))
        fit_width(&model_camera, is_named ? named->aspect : model->camera_aspect, p);
    *camera = choose(scene, p, is_named || model->has_camera ? &model_camera : NULL);
    if (!glms_vec3_eqv(camera->eye, camera->target))
        return STATUS_OK;
    /* far from the origin, rounding may make different positions equal */
    log_error(
        "the camera and its target have the same position: change --eye, --orbit or --target");
    return STATUS_USAGE;
}
