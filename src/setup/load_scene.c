/* load_scene.c: loads the scene that options describe, and completes its settings. */
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/base/log.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/render/renderer.h"
#include "src/scene/bundled_assets.h"
#include "src/scene/gpu_material_table.h"
#include "src/settings/scene_settings.h"
#include "src/setup/offer_materials.h"
#include "src/setup/offer_up_axis.h"
#include "src/setup/setup.h"
#include "src/setup/setup_material.h"
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
#include "src/tech/water/pool_parameters.h"

/* Optical depth of 1 % transmittance. */
#define OPAQUE_DEPTH 4.6f

/* Number of stops by which lights must overexpose the image for a note to be logged. */
#define BRIGHT_STOPS 4.0

/* Returns the inclusions of the --material option's preset. */
static enum material_inclusions inclusions_of(const struct setup_scene *options)
{
    struct material_choice choice;
    return material_choice_parse(&choice, options->material, strlen(options->material))
               ? choice.preset->inclusions
               : MATERIAL_CLEAR;
}

/* Returns true if --material names a kind of ice that has inclusions. */
static bool is_ice_chosen(const struct setup_scene *options)
{
    const enum material_inclusions inclusions =
        options->material ? inclusions_of(options) : MATERIAL_CLEAR;
    return inclusions == MATERIAL_ICE || inclusions == MATERIAL_WHITE_CORE;
}

/* Sets the settings of --material, which --set overrides. */
static void put_material(struct setup_scene *options, const struct scene *scene)
{
    struct material_choice choice;
    if (options->material &&
        material_choice_parse(&choice, options->material, strlen(options->material)))
        setup_put_material(&options->settings, &choice,
                           setup_absorption_scale(options->name, scene), SETTING_PRESET);
}

/* Sets the refractive index from the first of these that is given: --set, --material, --preset, the
 * model, the default. Returns true if the index is the model's. */
static bool choose_ior(struct setup_scene *options, const struct scene *scene)
{
    const struct model *model = &scene->model;
    const struct setting *ior =
        settings_row(&refract_settings, offsetof(struct refract_params, ior));
    return !options->material && model->has_ior &&
           settings_put(&options->settings, ior, (double)model->ior, SETTING_SCENE);
}

/* Switches on shadows and caustics of the sun if the sun lights opaque surroundings of a model
 * file. Keeps settings given by the user. */
static void choose_sun(struct setup_scene *options, const struct scene *scene)
{
    const struct setting *row =
        settings_row(&ice_caustics_settings, offsetof(struct ice_caustics_params, light));
    if (settings_source(&options->settings, row) == SETTING_DEFAULT && !options->plain &&
        !scene_find_builtin(options->name) && material_table_has_lit(&scene->model.surroundings) &&
        glms_vec3_max(frame_sun_light(scene, &options->settings)) > 0.0f)
        settings_put(&options->settings, row, ICE_CAUSTICS_SUN, SETTING_SCENE);
}

static void switch_off(struct setup_scene *options, const struct technique *technique)
{
    settings_put(&options->settings, &technique->settings->rows[0], 0, SETTING_SCENE);
}

/* Returns true if the scene's objects are ice when no --material is given. */
static bool has_ice(const struct scene *scene)
{
    return scene->has_pool ||
           (scene->model.object_count > 0 && frame_media_are_from_settings(scene));
}

/* Returns true if a bundled asset sets the technique's main setting and --material is not given. */
static bool has_default(const struct setup_scene *options, const struct technique *technique)
{
    return !options->material &&
           settings_source(&options->settings, &technique->settings->rows[0]) == SETTING_SCENE;
}

/* Returns true if the material needs a technique that is otherwise for ice: milk is a scattering
 * medium. */
static bool needs_technique(const struct setup_scene *options, const struct technique *technique)
{
    return technique == &air && options->material && inclusions_of(options) == MATERIAL_MILKY;
}

/* Switches off inclusions and bumps with --plain, or if the material is not ice. Highlights of
 * invisible lights are also switched off in a file of the user's with another material or --env. */
static void switch_off_ice_effects(struct setup_scene *options, const struct scene *scene)
{
    const bool is_ice = options->material ? is_ice_chosen(options) : has_ice(scene);
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_ice_only && (options->plain || (!is_ice && !has_default(options, *t) &&
                                                     !needs_technique(options, *t))))
            switch_off(options, *t);
    }
    const bool is_own =
        !scene_find_builtin(options->name) && !asset_find(options->name, ASSET_SCENE);
    if (options->plain ||
        (is_own && (!is_ice || (options->environment && !options->has_default_environment))))
        switch_off(options, &highlight);
}

/* Disables inclusions and bumps of ice whose walls are thinner than bubbles would be. Bumps, whose
 * size is that of the whole object, would make the faces of a wall intersect. A preset keeps them,
 * because that of the paper has bumps. */
static void clear_thin_walls(struct setup_scene *options, const struct scene *scene,
                             bool is_verbose)
{
    static const struct technique *const inclusions[] = { &air, &bubbles, &cracks };
    const bool is_ice = options->material ? is_ice_chosen(options) : has_ice(scene);
    bool has_any = false;
    if (!is_ice || options->plain || !setup_has_thin_walls(scene))
        return;
    for (size_t i = 0; i < sizeof(inclusions) / sizeof(inclusions[0]); i++) {
        const bool was_on = inclusions[i]->is_on(&options->settings);
        switch_off(options, inclusions[i]);
        has_any = has_any || (was_on && !inclusions[i]->is_on(&options->settings));
    }
    if (!options->preset)
        switch_off(options, &bump);
    if (has_any && is_verbose && !options->quiet)
        log_note("%s: its walls are too thin for bubbles, cracks and bumps, so it is clear ice; to "
                 "have them anyway, use for example --set cracks.count=2",
                 options->name);
}

/* Switches off inclusions if the scene has several objects, because only one is supported. */
static void check_inclusions(struct setup_scene *options, const struct scene *scene,
                             bool is_verbose)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        if (scene->model.object_count < 2 || !(*t)->is_ice_only || !(*t)->is_on(&options->settings))
            continue;
        if (is_verbose)
            log_warning("%s: left out, because the scene has %u refractive objects instead of one",
                        (*t)->title ? (*t)->title : (*t)->name, scene->model.object_count);
        settings_set_value(&options->settings, &(*t)->settings->rows[0], 0);
    }
}

/* Warns that a file's lights have no effect if there is no opaque surface for them to light. */
static void check_lights(const struct setup_scene *options, const struct scene *scene)
{
    if (scene->model.light_count > 0 && !scene->tables.punctual_lights)
        log_warning(
            "%s: its lights have no effect, because the scene has no opaque surface to light",
            options->name);
}

/* Logs a note if a file's lights, often in physical units, overexpose the image. */
static void note_brightness(const struct setup_scene *options, const struct scene *scene)
{
    const struct setting *exposure = settings_find("tonemap.exposure");
    const float radius = 0.5f * box_diagonal(scene->box);
    float brightest = 0.0f; /* illuminance, lux */
    for (uint32_t i = 0; i < scene->model.light_count && scene->tables.punctual_lights; i++) {
        const struct light *light = &scene->model.lights[i];
        const float distance = glms_vec3_distance(light->position, box_center(scene->box));
        const float d = light->kind == LIGHT_DIRECTIONAL ? 1.0f : fmaxf(distance, radius);
        brightest = fmaxf(brightest, glms_vec3_max(light->color) * light->intensity / (d * d));
    }
    const double stops = log2((double)brightest / (double)CGLM_PI);
    if (stops >= BRIGHT_STOPS && !options->quiet &&
        settings_source(&options->settings, exposure) < SETTING_PRESET)
        log_note("%s: its lights overexpose white surfaces by a factor of %.0f; use --set "
                 "tonemap.exposure=%.0f",
                 options->name, exp2(stops), fmax(-stops, exposure->min));
}

/* Returns true if an object should enclose a medium, but has holes. */
static bool is_open(const struct model *model, const struct object *object)
{
    const struct material *material = &model->materials[object->material];
    const bool is_thin = !(material->flags & MATERIAL_FROM_SETTINGS) && !(material->thickness > 0);
    return object->open_edge_count && !is_thin;
}

/* Returns a name of an object that is safe to print. */
static const char *object_name(const struct model *model, uint32_t index,
                               char text[static MATERIAL_NAME_SIZE])
{
    const char *name = model->objects[index].name;
    if (name[0])
        snprintf(text, MATERIAL_NAME_SIZE, "%s", name);
    else
        snprintf(text, MATERIAL_NAME_SIZE, "object %u", index);
    log_sanitize(text);
    return text;
}

/* Warns of objects that are not closed, in one line. */
static void check_shells(const struct setup_scene *options, const struct scene *scene)
{
    const struct model *model = &scene->model;
    const struct object *first = NULL;
    uint32_t count = 0;
    char others[32] = "", name[MATERIAL_NAME_SIZE];
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (is_open(model, &model->objects[i]) && !count++)
            first = &model->objects[i];
    }
    if (!first || options->quiet)
        return;
    if (count > 1)
        snprintf(others, sizeof(others), " and %u other%s", count - 1, count > 2 ? "s" : "");
    log_warning("%s: object %s%s %s open: its shell has %u edges around holes, through which "
                "light leaks between its medium and the air; close the holes, or give the surface "
                "a thickness",
                options->name, object_name(model, (uint32_t)(first - model->objects), name), others,
                count > 1 ? "are" : "is", first->open_edge_count);
}

static bool is_decided(const struct model *model, uint32_t object)
{
    return model->materials[model->objects[object].material].flags & MATERIAL_HAS_PRIORITY;
}

void setup_note_contacts(const struct setup_scene *options, const struct scene *scene)
{
    const struct model *model = &scene->model;
    char names[2][MATERIAL_NAME_SIZE];
    for (uint32_t i = 0; i < scene->contacts.pair_count; i++) {
        const struct coincident_pair pair = scene->contacts.pairs[i];
        const struct frame_medium a = frame_medium_at(scene, &options->settings, pair.first);
        const struct frame_medium b = frame_medium_at(scene, &options->settings, pair.second);
        if (is_decided(model, pair.first) || is_decided(model, pair.second) ||
            frame_media_are_equal(&a, &b))
            continue;
        const bool is_first = model->objects[pair.first].rank > model->objects[pair.second].rank;
        const uint32_t top = is_first ? pair.first : pair.second;
        log_note("%s: %s and %s share faces, and neither has a priority: where they overlap, the "
                 "medium of %s applies; to choose, set extras.priority of a material",
                 options->name, object_name(model, pair.first, names[0]),
                 object_name(model, pair.second, names[1]), names[top == pair.second]);
    }
    if (scene->contacts.has_more_pairs)
        log_note("%s: further objects may share faces", options->name);
}

/* Warns of an empty environment box. This is no error, because a user may be editing the box. */
static void check_box(const struct setup_scene *options, const struct scene *scene)
{
    const struct refract_params *refract = settings_of(&options->settings, &refract_settings);
    const struct box box = env_box_of(scene, &options->settings);
    const bool is_box = box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
    if (refract->lookup == REFRACT_LOOKUP_BOX && !is_box)
        log_warning("refract.lookup=box: the box is empty, so the environment is infinitely far "
                    "away; set env_box.min_x < max_x, min_y < max_y and min_z < max_z");
}

enum status setup_require_scene(const struct setup_scene *options)
{
    if (options->name)
        return STATUS_OK;
    log_error("SCENE is missing: expected a name of firn list scenes or a model file (see --help)");
    return STATUS_USAGE;
}

/* Logs a note that an object without materials is drawn as ice, which may not be intended. */
static void note_ice(const struct setup_scene *options, const struct scene *scene)
{
    if (!options->quiet && !options->material && !scene_is_known(options->name) && has_ice(scene))
        log_note("%s: has no materials, so it is drawn as ice; to change that, use for example "
                 "--material glass",
                 options->name);
}

/* Logs a note that offers --material for blended surfaces with names such as "glass". */
static void note_blended(const struct setup_scene *options, const struct scene *scene)
{
    if (!options->quiet && !options->material && !scene_is_known(options->name))
        offer_materials(options->name, &scene->model);
}

/* Logs a note that offers --up z if a model seems to be Z-up and no orientation is given. */
static void note_up_axis(const struct setup_scene *options, const struct scene *scene)
{
    const struct model *model = &scene->model;
    const struct model_transform *turn = &options->model_transform;
    const bool is_turned = turn->is_z_up || glms_vec3_norm2(turn->rotate_deg) > 0.0f ||
                           (options->has_transform && !(turn->scale > 0.0f)); /* --up y */
    if (!options->quiet && !is_turned && !scene_is_known(options->name))
        offer_up_axis(options->name,
                      model->object.index_count ? &model->object : &model->surroundings);
}

/* Logs a note if the medium of an object absorbs nearly all light, which may be a matter of scale.
 * Light crosses 4 V / A of a convex object on average (mean chord length). */
static void note_opaque(const struct setup_scene *options, const struct scene *scene)
{
    const struct model *model = &scene->model;
    char name[MATERIAL_NAME_SIZE];
    if (options->quiet || scene_find_builtin(options->name))
        return;
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct object *object = &model->objects[i];
        const struct frame_medium medium = frame_medium_at(scene, &options->settings, i);
        const float absorption = glms_vec3_min(medium.absorption);
        if (medium.is_thin || !(absorption > 0.0f))
            continue;
        const float path =
            2.0f * setup_wall_thickness(&model->object, object->first_index, object->index_count);
        if (absorption * path < OPAQUE_DEPTH)
            continue;
        const float now = options->model_transform.scale;
        const float half = logf(2.0f) / (absorption * path) * (now > 0.0f ? now : 1.0f);
        log_note("%s: %s absorbs more than 99 %% of the light that passes through it, %.3g metres "
                 "on average; if the unit of the file is not the metre, use for example --scale "
                 "%.2g, at which half of the light passes",
                 options->name, object_name(model, i, name), (double)path, (double)half);
        return;
    }
}

/* Lights ice on a stage by the panorama alone, without invisible lights. Of the inclusions only
 * bubbles remain, because planes of air and cracks, which are as large as the object, hide the
 * shape of a model at the size of a first image. */
static void choose_stage_ice(struct setup_scene *options, const struct scene *scene)
{
    const bool is_ice = options->material ? is_ice_chosen(options) : has_ice(scene);
    if (!stage_has_floor(&options->stage) || !is_ice)
        return;
    settings_put(&options->settings, settings_find("light.count"), 0, SETTING_SCENE);
    switch_off(options, &cracks);
    if (!air_is_medium(&options->settings))
        switch_off(options, &air);
}

struct settings_callback_data {
    struct setup_scene *options;
    struct bump_maps_params *maps;
};

static void finish_settings_callback(void *user, const struct scene *scene,
                                     struct scene_params *params)
{
    const struct settings_callback_data *settings_callback_data = user;
    note_ice(settings_callback_data->options, scene);
    note_blended(settings_callback_data->options, scene);
    put_material(settings_callback_data->options, scene);
    note_opaque(settings_callback_data->options, scene);
    note_up_axis(settings_callback_data->options, scene);
    setup_choose_stage(settings_callback_data->options, scene);
    setup_choose_stage_settings(settings_callback_data->options);
    switch_off_ice_effects(settings_callback_data->options, scene);
    clear_thin_walls(settings_callback_data->options, scene, true);
    check_inclusions(settings_callback_data->options, scene, true);
    choose_stage_ice(settings_callback_data->options, scene);
    *params = setup_scene_params(settings_callback_data->options, settings_callback_data->maps);
}

/* Returns true for --env valley, the built-in landscape. */
static bool is_valley(const struct setup_scene *options)
{
    return options->environment && asset_is_valley(options->environment);
}

/* Sets the default environment, `studio` or that of the asset, unless the options set one. */
static void choose_environment(struct setup_scene *options)
{
    const struct asset *environment = setup_default_environment(options->name);
    if (options->environment || options->surroundings || options->background.is_given ||
        !environment)
        return;
    options->has_default_environment = asset_exists(environment);
    if (options->has_default_environment)
        options->environment = environment->name;
    else if (!options->quiet)
        log_note("%s: not found, so the surroundings are the built-in sky; set FIRN_ASSETS to the "
                 "folder of firn's assets",
                 environment->file);
}

/* Applies the settings of a bundled asset. */
static enum status apply_asset_settings(struct setup_scene *options)
{
    const struct asset *scene = asset_find(options->name, ASSET_SCENE);
    enum status status = STATUS_OK;
    for (uint32_t i = 0;
         scene && i < ASSET_SETTING_COUNT && scene->settings[i] && status == STATUS_OK; i++)
        status = settings_assign(&options->settings, scene->settings[i], SETTING_SCENE, NULL);
    return status;
}

void setup_apply_scene_settings(struct setup_scene *options, const struct scene *scene)
{
    if (apply_asset_settings(options) != STATUS_OK)
        return; /* the error was logged */
    put_material(options, scene);
    switch_off_ice_effects(options, scene);
    clear_thin_walls(options, scene, false);
    check_inclusions(options, scene, false);
    choose_stage_ice(options, scene);
    (void)choose_ior(options, scene);
    setup_choose_stage_settings(options);
    choose_sun(options, scene);
    setup_put_exposure(options);
}

struct settings setup_scene_settings(const struct setup_scene *options, const struct scene *scene)
{
    struct setup_scene initial = *options;
    initial.plain = false;
    initial.settings = settings_default();
    setup_apply_scene_settings(&initial, scene);
    return initial.settings;
}

static struct melting melting_of(const struct setup_scene *options)
{
    const struct ice_params *ice = settings_of(&options->settings, &ice_settings);
    const struct motion_params *motion = settings_of(&options->settings, &motion_settings);
    const bool is_ice = is_ice_chosen(options);
    return (struct melting){ ice->melt, motion->melt, is_ice, options->material && !is_ice };
}

struct scene_params setup_scene_params(const struct setup_scene *options,
                                       struct bump_maps_params *maps)
{
    const struct object_params *object = settings_of(&options->settings, &object_settings);
    const struct landscape_params *landscape = settings_of(&options->settings, &landscape_settings);
    const struct motion_params *motion = settings_of(&options->settings, &motion_settings);
    const struct bump_params *bumps = settings_of(&options->settings, &bump_settings);
    const struct air_params *planes = settings_of(&options->settings, &air_settings);
    const struct bubbles_params *holes = settings_of(&options->settings, &bubbles_settings);
    const struct cracks_params *sheets = settings_of(&options->settings, &cracks_settings);
    const struct pool_params *pool = settings_of(&options->settings, &pool_settings);
    const bool is_at_rest = options->animation && !strcmp(options->animation, "none");
    *maps = (struct bump_maps_params){ .smooth = bumps->mask, .seed = bumps->seed };
    return (struct scene_params){
        .name = options->name,
        .surroundings = options->surroundings,
        .is_one_object = options->material != NULL,
        .model_transform = options->has_transform ? &options->model_transform : NULL,
        .pose = { .animation = is_at_rest ? NULL : options->animation,
                  .is_first = !options->animation },
        .material_overrides = options->material_overrides,
        .material_override_count = options->material_override_count,
        .object_transforms = options->object_transforms,
        .object_transform_count = options->object_transform_count,
        .environment = is_valley(options) ? NULL : options->environment,
        .environment_turn = options->env_rotate / 360.0f - floorf(options->env_rotate / 360.0f),
        .environment_exposure = options->env_exposure,
        .background = options->background.is_given ? &options->background.value : NULL,
        .is_backdrop = options->background.is_given && options->environment,
        .is_hidden = options->no_background,
        .stage = options->stage,
        .object_triangles = object->triangles,
        .landscape_triangles = landscape->triangles,
        .flat = landscape->flat,
        .orbiting_ball_count = motion->count,
        .melting = melting_of(options),
        .air = { planes->count, planes->seed, planes->size, planes->frequency },
        .has_scattering_medium = air_is_medium(&options->settings),
        .scatters_evenly = planes->model == AIR_EVEN,
        .bubbles = { holes->count, holes->seed, holes->size, holes->shape, holes->stretch },
        .bump = bump.is_on(&options->settings) || frost.is_on(&options->settings) ? maps : NULL,
        .cracks = { sheets->count, sheets->seed, sheets->size, options->cracks },
        .image_files = { options->bump, options->bump_mask, options->air },
        .decode = &options->reader,
        .source = options->source,
        .files = options->files,
        .pool = { pool->size, pool->depth, pool->ice },
        .defers_texels = true,
    };
}

const char *setup_fill_scene(struct scene *scene, const struct setup_scene *options)
{
    struct bump_maps_params maps;
    const struct scene_params params = setup_scene_params(options, &maps);
    return scene_fill(scene, &params);
}

enum status setup_update_materials(struct scene *scene, const struct setup_scene *options)
{
    struct bump_maps_params maps;
    const struct scene_params params = setup_scene_params(options, &maps);
    return scene_update_materials(scene, &params);
}

enum status setup_log_fill_failure(const char *lacking)
{
    log_error("%s: out of memory", lacking);
    return STATUS_TRY_AGAIN;
}

enum status setup_pose_scene(struct scene *scene, const struct setup_scene *options, float time,
                             bool *is_changed)
{
    struct bump_maps_params maps;
    struct scene posed;
    *is_changed = scene->is_animated && (time < scene->time || time > scene->time);
    if (!*is_changed)
        return STATUS_OK;
    struct scene_params params = setup_scene_params(options, &maps);
    struct reader_params reader = options->reader;
    reader.no_warnings = true; /* do not repeat the warnings of the first load */
    params.decode = &reader;
    params.previous_pose = scene;
    params.pose.time = time;
    params.defers_texels = false;
    const enum status status = scene_load(&posed, &params);
    if (status != STATUS_OK)
        return status;
    posed.model_ior = scene->model_ior;
    posed.framing_box = scene->framing_box;
    posed.framing = scene->framing;
    scene_finish(scene);
    *scene = posed;
    return STATUS_OK;
}

/* Poses and fills a scene that setup_begin_scene() has begun to load. */
static enum status pose_and_fill(struct scene *scene, const struct setup_scene *options)
{
    const struct motion_params *motion = settings_of(&options->settings, &motion_settings);
    bool is_filled = false;
    enum status status = setup_pose_scene(scene, options, motion->time, &is_filled);
    const char *lacking =
        status == STATUS_OK && !is_filled ? setup_fill_scene(scene, options) : NULL;
    return lacking ? setup_log_fill_failure(lacking) : status;
}

enum status setup_load_scene(struct scene *scene, struct setup_scene *options)
{
    enum status status = setup_begin_scene(scene, options);
    if (status == STATUS_OK)
        status = pose_and_fill(scene, options);
    if (status != STATUS_OK)
        scene_finish(scene);
    return status;
}

enum status setup_load_exposed(struct scene *scene, struct camera *camera,
                               struct setup_image *image)
{
    enum status status = setup_begin_scene(scene, &image->scene);
    if (status == STATUS_OK)
        status = setup_camera(camera, scene, image);
    if (status == STATUS_OK)
        status = setup_choose_exposure(image, scene, camera);
    if (status == STATUS_OK)
        status = pose_and_fill(scene, &image->scene);
    if (status == STATUS_OK)
        status = setup_camera(camera, scene, image);
    if (status != STATUS_OK)
        scene_finish(scene);
    return status;
}

bool setup_print_transform(const struct object_transform *t, char text[static SETUP_TRANSFORM_SIZE])
{
    const struct object_transform shown = {
        .move = t->move,
        .rotate_deg = t->rotate_deg,
        .scale = t->scale > 0.0f ? t->scale : 1.0f,
    };
    int length = snprintf(text, SETUP_TRANSFORM_SIZE, "%s=%.7g,%.7g,%.7g", t->name,
                          (double)shown.move.x, (double)shown.move.y, (double)shown.move.z);
    const bool is_scaled = shown.scale < 1.0f || shown.scale > 1.0f;
    if (is_scaled || glms_vec3_norm2(shown.rotate_deg) > 0.0f)
        length += snprintf(&text[length], SETUP_TRANSFORM_SIZE - (size_t)length, ",%.7g,%.7g,%.7g",
                           (double)shown.rotate_deg.x, (double)shown.rotate_deg.y,
                           (double)shown.rotate_deg.z);
    if (is_scaled)
        snprintf(&text[length], SETUP_TRANSFORM_SIZE - (size_t)length, ",%.7g",
                 (double)shown.scale);
    return !object_transform_is_identity(&shown);
}

/* Refuses transform, animation and node materials for scenes that are not model files. */
static enum status check_transform(const struct setup_scene *options)
{
    const char *refused = options->has_transform             ? "--up, --scale and --rotate"
                          : options->animation               ? "--animation"
                          : options->material_override_count ? "--material NODE=..."
                          : options->object_transform_count  ? "--transform and --hide"
                                                             : NULL;
    if (!refused || !scene_find_builtin(options->name))
        return STATUS_OK;
    log_error("%s: not available for the built-in scene '%s': expected a model file", refused,
              options->name);
    return STATUS_USAGE;
}

/* Refuses --env-rotate and --env-exposure without environment file, and --env-rotate for a cube. */
static enum status check_environment(const struct setup_scene *options, const struct scene *scene)
{
    const bool is_rotated = fabsf(options->env_rotate) > 0.0f;
    const bool is_exposed = fabsf(options->env_exposure) > 0.0f;
    if ((!options->environment || is_valley(options)) && (is_rotated || is_exposed)) {
        log_error("--env-%s: --env is missing", is_rotated ? "rotate" : "exposure");
        return STATUS_USAGE;
    }
    if (is_rotated && scene->background.cube.texels) {
        log_error("--env-rotate: not available for a cube: expected an equirectangular image "
                  "as --env");
        return STATUS_USAGE;
    }
    return STATUS_OK;
}

enum status setup_begin_scene(struct scene *scene, struct setup_scene *options)
{
    struct bump_maps_params maps;
    struct settings_callback_data settings_callback_data = { options, &maps };
    *scene = (struct scene){ 0 };
    if (setup_require_scene(options) != STATUS_OK || check_transform(options) != STATUS_OK ||
        setup_check_ground(options) != STATUS_OK)
        return STATUS_USAGE;
    if (apply_asset_settings(options) != STATUS_OK)
        return STATUS_USAGE;
    choose_environment(options);
    struct scene_params params = setup_scene_params(options, &maps);
    params.on_object_loaded = finish_settings_callback;
    params.user = &settings_callback_data;
    enum status status = scene_load(scene, &params);
    if (status == STATUS_OK)
        status = check_environment(options, scene);
    if (status != STATUS_OK) {
        scene_finish(scene);
    } else {
        scene->model_ior = choose_ior(options, scene) ? scene->model.ior : 0.0f;
        choose_sun(options, scene);
        check_box(options, scene);
        check_lights(options, scene);
        check_shells(options, scene);
        note_brightness(options, scene);
        if (!options->quiet)
            setup_note_contacts(options, scene);
    }
    return status;
}

struct renderer_params setup_renderer_params(const struct setup_image *p, struct gpu *gpu,
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
    };
}
