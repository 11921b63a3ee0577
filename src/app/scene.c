/* scene.c: what the options say of scene and camera. */
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/frame/view.h"
#include "src/scene/material.h"
#include "src/settings/scene_settings.h"
#include "src/tech/air.h"
#include "src/tech/bubbles.h"
#include "src/tech/bump.h"
#include "src/tech/cracks.h"
#include "src/tech/frost.h"
#include "src/tech/local_box.h"
#include "src/tech/pool.h"
#include "src/tech/refract.h"

static const float default_fov_deg = 45.0f;
static const uint32_t default_width = 1024;
static const uint32_t default_height = 768;

/* --set over --material over the model's own index over the default. */
static void settle_ior(struct app_options *o, const struct model *model)
{
    const struct setting *ior =
        settings_row(&refract_settings, offsetof(struct refract_params, ior));
    if (o->ior_is_set)
        return;
    if (o->material)
        settings_put(&o->settings, ior, (double)material_find(o->material)->ior);
    else if (model->has_ior)
        settings_put(&o->settings, ior, (double)model->ior);
}

/* No box is no error: a window's user may be about to say one. */
static void check_box(const struct app_options *o, const struct scene *scene)
{
    const struct refract_params *refract = settings_of(&o->settings, &refract_settings);
    const struct box box = local_box_of(scene, &o->settings);
    const bool is_box = box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
    if (refract->lookup == REFRACT_LOOKUP_BOX && !is_box)
        log_warning("refract.lookup=box: the box is empty, so the environment is infinitely far "
                    "away; set local.left < right, bottom < top and back < front");
}

enum status app_need_scene(const struct app_options *o)
{
    if (o->positionals[0])
        return STATUS_OK;
    log_error("SCENE is missing: expected ice-cube, sphere, teapot, room, pool or a model file "
              "(see --help)");
    return STATUS_USAGE;
}

/* The rungs that are drawn leave the water alone; the tracer, which is no technique, knows none. */
static enum status check_pool(const struct app_options *o, struct scene *scene)
{
    if (!scene->has_pool || !o->rung || o->rung->rung.rows)
        return STATUS_OK;
    log_error(
        "--refraction %s: not available for the scene '%s', which has water; choose another rung",
        o->rung->rung.name, o->positionals[0]);
    scene_finish(scene);
    return STATUS_USAGE;
}

struct scene_params app_describe_scene(const struct app_options *o, struct bump_maps_params *maps)
{
    const struct object_params *object = settings_of(&o->settings, &object_settings);
    const struct landscape_params *landscape = settings_of(&o->settings, &landscape_settings);
    const struct motion_params *motion = settings_of(&o->settings, &motion_settings);
    const struct bump_params *bumps = settings_of(&o->settings, &bump_settings);
    const struct air_params *planes = settings_of(&o->settings, &air_settings);
    const struct bubbles_params *spheres = settings_of(&o->settings, &bubbles_settings);
    const struct cracks_params *sheets = settings_of(&o->settings, &cracks_settings);
    const struct pool_params *pool = settings_of(&o->settings, &pool_settings);
    *maps = (struct bump_maps_params){ .smooth = bumps->mask, .seed = bumps->seed };
    return (struct scene_params){
        .name = o->positionals[0],
        .surroundings = o->surroundings,
        .environment = o->environment,
        .background = o->has_background ? &o->background : NULL,
        .object_triangles = object->triangles,
        .landscape_triangles = landscape->triangles,
        .flat = landscape->flat,
        .mover_count = motion->count,
        .air = { planes->count, planes->seed, planes->size, planes->frequency },
        .bubbles = { spheres->count, spheres->seed, spheres->size },
        .bump = bump.is_on(&o->settings) || frost.is_on(&o->settings) ? maps : NULL,
        .cracks = { sheets->count, sheets->seed, sheets->clip == CRACKS_CLIP_PRECUT },
        .pool = { pool->size, pool->depth, pool->ice },
        .later = true,
    };
}

const char *app_fill_scene(struct scene *scene, const struct app_options *o)
{
    struct bump_maps_params maps;
    const struct scene_params params = app_describe_scene(o, &maps);
    return scene_fill(scene, &params);
}

enum status app_fill_failed(const char *lacking)
{
    log_error("%s: out of memory", lacking);
    return STATUS_TRY_AGAIN;
}

enum status app_load_scene(struct scene *scene, struct app_options *o)
{
    enum status status = app_begin_scene(scene, o);
    const char *lacking = status == STATUS_OK ? app_fill_scene(scene, o) : NULL;
    if (lacking)
        status = app_fill_failed(lacking);
    if (status != STATUS_OK)
        scene_finish(scene);
    return status;
}

enum status app_begin_scene(struct scene *scene, struct app_options *o)
{
    const struct decode_params decode = {
        .program = "/proc/self/exe",
        .seconds = o->load_seconds,
        .memory_gib = o->load_memory_gib,
    };
    struct bump_maps_params maps;
    struct scene_params params = app_describe_scene(o, &maps);
    *scene = (struct scene){ 0 };
    if (app_need_scene(o) != STATUS_OK)
        return STATUS_USAGE;
    if (!o->width) {
        o->width = default_width;
        o->height = default_height;
    }
    params.decode = &decode;
    enum status status = scene_load(scene, &params);
    if (status == STATUS_OK)
        status = check_pool(o, scene);
    if (status == STATUS_OK) {
        settle_ior(o, &scene->model);
        check_box(o, scene);
        /* what frames know from the scene, pictures tell in their settings */
        if (scene->cube.texels)
            settings_put(
                &o->settings,
                settings_row(&env_cube_settings, offsetof(struct env_cube_params, dynamic)), 0.0);
        settings_put(&o->settings, POOL_IS_ON_ROW, scene->has_pool);
    }
    return status;
}

static struct camera choose_camera(const struct scene *scene, const struct app_options *o)
{
    const vec3s center = box_center(scene->box);
    const vec3s target = o->has_target ? o->target : center;
    const float fov = o->has_fov ? o->fov_deg : default_fov_deg;
    if (o->has_eye)
        return (struct camera){ .eye = o->eye, .target = target, .fov_deg = fov };
    if (scene->model.has_camera && !o->has_orbit) {
        struct camera own = scene->model.camera;
        own.fov_deg = o->has_fov ? fov : own.fov_deg;
        own.target = o->has_target ? target : own.target;
        return own;
    }
    float distance = camera_framing_distance(box_diagonal(scene->box), fov, o->width, o->height);
    if (!(distance > 0.0f)) /* a point, or nothing */
        distance = 1.0f;
    const vec3s orbit = o->has_orbit ? o->orbit : (vec3s){ { 28.0f, 9.0f, distance } };
    return camera_orbit(orbit.x, orbit.y, orbit.z, target, fov);
}

enum status app_camera(struct camera *camera, const struct scene *scene,
                       const struct app_options *o)
{
    if (o->has_eye && o->has_orbit) {
        log_error("--eye conflicts with --orbit: choose one camera position");
        return STATUS_USAGE;
    }
    *camera = choose_camera(scene, o);
    if (!glms_vec3_eqv(camera->eye, camera->target))
        return STATUS_OK;
    /* maybe only as floats go: there is no millimetre a thousand kilometres away */
    log_error(
        "the camera and its target have the same position: change --eye, --orbit or --target");
    return STATUS_USAGE;
}
