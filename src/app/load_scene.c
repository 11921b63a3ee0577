/* load_scene.c: translates options into scene and renderer parameters, and settles scene settings.
 */
#include <math.h>
#include <string.h>
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/frame/frame_uniforms.h"
#include "src/render/renderer.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/material.h"
#include "src/scene/material_table.h"
#include "src/settings/scene_settings.h"
#include "src/tech/frame_media.h"
#include "src/tech/inclusions/air.h"
#include "src/tech/inclusions/bubbles.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/inclusions/frost.h"
#include "src/tech/lighting/bump.h"
#include "src/tech/lighting/highlight.h"
#include "src/tech/lighting/ice_caustics.h"
#include "src/tech/refract/env_box.h"
#include "src/tech/refract/refract.h"
#include "src/tech/techniques.h"
#include "src/tech/water/pool.h"

/* Stops above white at which a file's lights are reported as too bright. */
#define BRIGHT_STOPS 4.0

/* Sets the refractive index. Precedence: --set, --material, --preset, the model's own, the default.
 * Returns true if it is the model's. */
static bool settle_ior(struct app_scene *given, const struct scene *scene)
{
    const struct model *model = &scene->model;
    const struct setting *ior =
        settings_row(&refract_settings, offsetof(struct refract_params, ior));
    const size_t index = settings_index(ior);
    const bool is_own =
        !given->is_set[index] && !given->material && model->has_ior && !given->is_preset[index];
    if (is_own)
        settings_set_value(&given->settings, ior, (double)model->ior);
    else if (!given->is_set[index] && given->material)
        settings_set_value(&given->settings, ior,
                           (double)material_preset_find(given->material)->ior);
    return is_own;
}

/* Switches on shadows and caustics of the sun if it lights a model file's opaque surroundings,
 * unless the setting is given. */
static void settle_sun(struct app_scene *given, const struct scene *scene)
{
    const struct setting *row =
        settings_row(&ice_caustics_settings, offsetof(struct ice_caustics_params, light));
    const size_t index = settings_index(row);
    const bool is_given = given->is_set[index] || given->is_preset[index] || given->is_own[index];
    if (!is_given && !given->plain && !scene_find_builtin(given->name) &&
        material_table_has_lit(&scene->model.surroundings) &&
        glms_vec3_max(frame_sun_light(scene, &given->settings)) > 0.0f)
        settings_set_value(&given->settings, row, ICE_CAUSTICS_SUN);
}

static void switch_off(struct app_scene *given, const struct technique *technique)
{
    const struct setting *row = &technique->settings[0]->rows[0];
    const size_t index = settings_index(row);
    if (!given->is_set[index] && !given->is_preset[index])
        settings_set_value(&given->settings, row, 0);
}

/* Returns true if the scene's objects are ice unless --material overrides that. */
static bool has_ice(const struct scene *scene)
{
    return scene->has_pool ||
           (scene->model.object_count > 0 && frame_media_are_from_settings(scene));
}

/* Returns true if an asset with its own material sets inclusions of this kind itself. */
static bool has_own(const struct app_scene *given, const struct technique *technique)
{
    return !given->material && given->is_own[settings_index(&technique->settings[0]->rows[0])];
}

/* Switches off inclusions and bumps that only ice has, for other materials and with --plain. */
static void switch_off_ice_effects(struct app_scene *given, const struct scene *scene)
{
    const bool is_ice =
        given->material ? !strcmp(given->material, material_presets[0].name) : has_ice(scene);
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_ice_only && (given->plain || (!is_ice && !has_own(given, *t))))
            switch_off(given, *t);
    }
    if (given->plain)
        switch_off(given, &highlight);
}

/* Switches off inclusions in scenes with several refractive objects: they belong to one object. */
static void check_inclusions(struct app_scene *given, const struct scene *scene, bool is_verbose)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        if (scene->model.object_count < 2 || !(*t)->is_ice_only || !(*t)->is_on(&given->settings))
            continue;
        if (is_verbose)
            log_warning("%s: left out, because the scene has %u refractive objects",
                        (*t)->title ? (*t)->title : (*t)->name, scene->model.object_count);
        settings_set_value(&given->settings, &(*t)->settings[0]->rows[0], 0);
    }
}

/* Warns if the lights of a file have no effect, because only opaque surfaces are lit by them. */
static void check_lights(const struct app_scene *given, const struct scene *scene)
{
    if (scene->model.light_count > 0 && !scene->punctual_light_table)
        log_warning(
            "%s: its lights have no effect: they light only opaque surfaces that are not unlit, "
            "and the scene has none",
            given->name);
}

/* Notes lights in physical units, as other programs write them, that overexpose the image. */
static void note_brightness(const struct app_scene *given, const struct scene *scene)
{
    const struct setting *exposure = settings_find("tonemap.exposure");
    const float radius = 0.5f * box_diagonal(scene->box);
    float most = 0.0f; /* illuminance, lux */
    for (uint32_t i = 0; i < scene->model.light_count && scene->punctual_light_table; i++) {
        const struct light *light = &scene->model.lights[i];
        const float distance = glms_vec3_distance(light->position, box_center(scene->box));
        const float d = light->kind == LIGHT_DIRECTIONAL ? 1.0f : fmaxf(distance, radius);
        most = fmaxf(most, glms_vec3_max(light->color) * light->intensity / (d * d));
    }
    const double stops = log2((double)most / (double)CGLM_PI);
    if (stops >= BRIGHT_STOPS && !given->quiet && !given->is_preset[settings_index(exposure)] &&
        !given->is_set[settings_index(exposure)])
        log_note("%s: its lights make white surfaces %.0f times as bright as white; "
                 "--set tonemap.exposure=%.0f shows them",
                 given->name, exp2(stops), fmax(-stops, exposure->min));
}

/* Warns if the environment box is empty; no error, since a window's user may be editing it. */
static void check_box(const struct app_scene *given, const struct scene *scene)
{
    const struct refract_params *refract = settings_of(&given->settings, &refract_settings);
    const struct box box = env_box_of(scene, &given->settings);
    const bool is_box = box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
    if (refract->lookup == REFRACT_LOOKUP_BOX && !is_box)
        log_warning("refract.lookup=box: the box is empty, so the environment is infinitely far "
                    "away; set env_box.min_x < right, bottom < top and back < front");
}

enum status app_require_scene(const struct app_scene *given)
{
    if (given->name)
        return STATUS_OK;
    log_error("SCENE is missing: expected a name of firn list scenes or a model file (see --help)");
    return STATUS_USAGE;
}

/* Notes that an object without materials is drawn as ice, which its author may not have meant. */
static void note_ice(const struct app_scene *given, const struct scene *scene)
{
    if (!given->quiet && !given->material && !scene_is_known(given->name) && has_ice(scene))
        log_note("%s: has no materials, so it is drawn as ice; to change it, use for example "
                 "--material glass",
                 given->name);
}

struct settling {
    struct app_scene *given;
    struct bump_maps_params *maps;
};

static void settle_callback(void *user, const struct scene *scene, struct scene_params *params)
{
    const struct settling *settling = user;
    note_ice(settling->given, scene);
    switch_off_ice_effects(settling->given, scene);
    check_inclusions(settling->given, scene, true);
    *params = app_scene_params(settling->given, settling->maps);
}

/* Returns true for --env valley: the built-in landscape, also around a model file. */
static bool is_valley(const struct app_scene *given)
{
    return given->environment && asset_is_valley(given->environment);
}

const struct asset *app_own_environment(const char *name)
{
    const struct asset *scene = asset_find(name, ASSET_SCENE);
    const char *own = scene ? scene->environment : scene_find_builtin(name) ? NULL : "studio";
    return own ? asset_find(own, ASSET_ENVIRONMENT) : NULL;
}

/* Sets the default environment (`studio` or an asset's own) unless options set one. */
static void choose_environment(struct app_scene *given)
{
    const struct asset *environment = app_own_environment(given->name);
    if (given->environment || given->surroundings || given->background.is_given || !environment)
        return;
    given->has_own_environment = asset_exists(environment);
    if (given->has_own_environment)
        given->environment = environment->name;
    else if (!given->quiet)
        log_note("%s: not found, so the surroundings are the built-in sky; set FIRN_ASSETS to the "
                 "folder of firn's assets",
                 environment->file);
}

/* Applies the default settings of an asset. */
static enum status apply_asset_settings(struct app_scene *given)
{
    const struct asset *scene = asset_find(given->name, ASSET_SCENE);
    memset(given->is_own, 0, sizeof(given->is_own));
    for (uint32_t i = 0; scene && i < ASSET_SETTING_COUNT && scene->settings[i]; i++) {
        struct settings settings = given->settings;
        const struct setting *row;
        const enum status status = settings_assign(&settings, scene->settings[i], NULL, &row);
        if (status != STATUS_OK)
            return status;
        const size_t index = settings_index(row);
        if (given->is_set[index] || given->is_preset[index])
            continue;
        given->settings = settings;
        given->is_own[index] = true;
    }
    return STATUS_OK;
}

void app_apply_scene_settings(struct app_scene *given, const struct scene *scene)
{
    if (apply_asset_settings(given) != STATUS_OK)
        return; /* loading the asset has logged the error */
    switch_off_ice_effects(given, scene);
    check_inclusions(given, scene, false);
    (void)settle_ior(given, scene);
    settle_sun(given, scene);
}

struct settings app_scene_settings(const struct app_scene *given, const struct scene *scene)
{
    struct app_scene own = *given;
    own.plain = false;
    own.settings = settings_default();
    memset(own.is_set, 0, sizeof(own.is_set));
    memset(own.is_preset, 0, sizeof(own.is_preset));
    app_apply_scene_settings(&own, scene);
    return own.settings;
}

static struct melting melting_of(const struct app_scene *given)
{
    const struct ice_params *ice = settings_of(&given->settings, &ice_settings);
    const struct motion_params *motion = settings_of(&given->settings, &motion_settings);
    const bool is_ice = given->material && !strcmp(given->material, material_presets[0].name);
    return (struct melting){ ice->melt, motion->melt, is_ice, given->material && !is_ice };
}

struct scene_params app_scene_params(const struct app_scene *given, struct bump_maps_params *maps)
{
    const struct object_params *object = settings_of(&given->settings, &object_settings);
    const struct landscape_params *landscape = settings_of(&given->settings, &landscape_settings);
    const struct motion_params *motion = settings_of(&given->settings, &motion_settings);
    const struct bump_params *bumps = settings_of(&given->settings, &bump_settings);
    const struct air_params *planes = settings_of(&given->settings, &air_settings);
    const struct bubbles_params *holes = settings_of(&given->settings, &bubbles_settings);
    const struct cracks_params *sheets = settings_of(&given->settings, &cracks_settings);
    const struct pool_params *pool = settings_of(&given->settings, &pool_settings);
    const bool is_at_rest = given->animation && !strcmp(given->animation, "none");
    *maps = (struct bump_maps_params){ .smooth = bumps->mask, .seed = bumps->seed };
    return (struct scene_params){
        .name = given->name,
        .surroundings = given->surroundings,
        .is_one_object = given->material != NULL,
        .model_transform = given->is_placed ? &given->model_transform : NULL,
        .pose = { .animation = is_at_rest ? NULL : given->animation,
                  .is_first = !given->animation },
        .material_overrides = given->material_overrides,
        .material_override_count = given->material_override_count,
        .environment = is_valley(given) ? NULL : given->environment,
        .environment_turn = given->env_rotate / 360.0f - floorf(given->env_rotate / 360.0f),
        .environment_exposure = given->env_exposure,
        .background = given->background.is_given ? &given->background.value : NULL,
        .is_hidden = given->no_background,
        .object_triangles = object->triangles,
        .landscape_triangles = landscape->triangles,
        .flat = landscape->flat,
        .orbiting_ball_count = motion->count,
        .melting = melting_of(given),
        .air = { planes->count, planes->seed, planes->size, planes->frequency },
        .has_scattering_medium = air_is_medium(&given->settings),
        .bubbles = { holes->count, holes->seed, holes->size, holes->shape, holes->stretch },
        .bump = bump.is_on(&given->settings) || frost.is_on(&given->settings) ? maps : NULL,
        .cracks = { sheets->count, sheets->seed, sheets->size, sheets->clip == CRACKS_CLIP_PRECUT,
                    given->cracks },
        .pictures = { given->bump, given->bump_mask, given->air },
        .decode = &given->reader,
        .pool = { pool->size, pool->depth, pool->ice },
        .later = true,
    };
}

const char *app_fill_scene(struct scene *scene, const struct app_scene *given)
{
    struct bump_maps_params maps;
    const struct scene_params params = app_scene_params(given, &maps);
    return scene_fill(scene, &params);
}

enum status app_log_fill_failure(const char *lacking)
{
    log_error("%s: out of memory", lacking);
    return STATUS_TRY_AGAIN;
}

enum status app_pose_scene(struct scene *scene, const struct app_scene *given, float time,
                           bool *is_changed)
{
    struct bump_maps_params maps;
    struct scene posed;
    *is_changed = scene->is_animated && (time < scene->time || time > scene->time);
    if (!*is_changed)
        return STATUS_OK;
    struct scene_params params = app_scene_params(given, &maps);
    struct reader_params reader = given->reader;
    reader.no_warnings = true; /* warnings were logged when the scene was first loaded */
    params.decode = &reader;
    params.before = scene;
    params.pose.time = time;
    params.later = false;
    const enum status status = scene_load(&posed, &params);
    if (status != STATUS_OK)
        return status;
    posed.model_ior = scene->model_ior;
    posed.framing_box = scene->framing_box;
    scene_finish(scene);
    *scene = posed;
    return STATUS_OK;
}

enum status app_load_scene(struct scene *scene, struct app_scene *given)
{
    const struct motion_params *motion = settings_of(&given->settings, &motion_settings);
    bool is_filled = false;
    enum status status = app_begin_scene(scene, given);
    if (status == STATUS_OK)
        status = app_pose_scene(scene, given, motion->time, &is_filled);
    const char *lacking = status == STATUS_OK && !is_filled ? app_fill_scene(scene, given) : NULL;
    if (lacking)
        status = app_log_fill_failure(lacking);
    if (status != STATUS_OK)
        scene_finish(scene);
    return status;
}

/* Refuses transform, animation and node materials for scenes that are not model files. */
static enum status check_place(const struct app_scene *given)
{
    const char *options = given->is_placed                 ? "--up, --scale and --rotate"
                          : given->animation               ? "--animation"
                          : given->material_override_count ? "--material NODE=..."
                                                           : NULL;
    if (!options || !scene_find_builtin(given->name))
        return STATUS_OK;
    log_error("%s: not available for the built-in scene '%s': expected a model file", options,
              given->name);
    return STATUS_USAGE;
}

/* Refuses --env-rotate and --env-exposure without an environment file, or with a cube. */
static enum status check_environment(const struct app_scene *given, const struct scene *scene)
{
    const bool is_turned = fabsf(given->env_rotate) > 0.0f;
    const bool is_exposed = fabsf(given->env_exposure) > 0.0f;
    if ((!given->environment || is_valley(given)) && (is_turned || is_exposed)) {
        log_error("--env-%s: --env is missing", is_turned ? "rotate" : "exposure");
        return STATUS_USAGE;
    }
    if (is_turned && scene->cube.texels) {
        log_error("--env-rotate: not available for a cube: expected an equirectangular image "
                  "as --env");
        return STATUS_USAGE;
    }
    return STATUS_OK;
}

enum status app_begin_scene(struct scene *scene, struct app_scene *given)
{
    struct bump_maps_params maps;
    struct settling settling = { given, &maps };
    *scene = (struct scene){ 0 };
    if (app_require_scene(given) != STATUS_OK || check_place(given) != STATUS_OK)
        return STATUS_USAGE;
    if (apply_asset_settings(given) != STATUS_OK)
        return STATUS_USAGE;
    choose_environment(given);
    struct scene_params params = app_scene_params(given, &maps);
    params.settle = settle_callback;
    params.user = &settling;
    enum status status = scene_load(scene, &params);
    if (status == STATUS_OK)
        status = check_environment(given, scene);
    if (status != STATUS_OK) {
        scene_finish(scene);
    } else {
        scene->model_ior = settle_ior(given, scene) ? scene->model.ior : 0.0f;
        settle_sun(given, scene);
        check_box(given, scene);
        check_lights(given, scene);
        note_brightness(given, scene);
    }
    return status;
}

struct renderer_params app_renderer_params(const struct app_image *p, struct gpu *gpu,
                                           const struct scene *scene)
{
    return (struct renderer_params){
        .gpu = gpu,
        .scene = scene,
        .settings = &p->scene.settings,
        .refraction = p->refraction,
        .width = p->width,
        .height = p->height,
        .columns = p->columns,
        .rows = p->rows,
        .is_adaptive = p->is_adaptive,
        .filter = p->filter,
        .interleaved = p->interleaved,
        .sharing = p->sharing,
    };
}
