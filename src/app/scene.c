/* scene.c: what the options say of scene, camera and renderer. */
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "shaders/tree.h"
#include "src/app/app.h"
#include "src/base/log.h"
#include "src/frame/view.h"
#include "src/render/renderer.h"
#include "src/scene/asset.h"
#include "src/scene/material.h"
#include "src/scene/material_rows.h"
#include "src/settings/scene_settings.h"
#include "src/tech/air.h"
#include "src/tech/bubbles.h"
#include "src/tech/bump.h"
#include "src/tech/cracks.h"
#include "src/tech/frame_media.h"
#include "src/tech/frost.h"
#include "src/tech/local_box.h"
#include "src/tech/pool.h"
#include "src/tech/refract.h"
#include "src/tech/refract_bounce.h"
#include "src/tech/refract_trace.h"
#include "src/tech/surface.h"
#include "src/tech/techniques.h"

/* Of half a box: what touches an object from outside is not in it. */
#define INNER_SHARE 0.9f

/* --set over --material over --preset over the model's own index over the default. */
static void settle_ior(struct app_scene *given, struct scene *scene)
{
    const struct model *model = &scene->model;
    const struct setting *ior =
        settings_row(&refract_settings, offsetof(struct refract_params, ior));
    const size_t index = settings_index(ior);
    if (given->is_set[index])
        return;
    if (given->material)
        settings_put(&given->settings, ior, (double)material_preset_find(given->material)->ior);
    else if (model->has_ior && !given->is_preset[index]) {
        settings_put(&given->settings, ior, (double)model->ior);
        scene->settled_ior = model->ior;
    }
}

static void switch_off(struct app_scene *given, const struct technique *technique)
{
    const struct setting *row = &technique->settings[0]->rows[0];
    const size_t index = settings_index(row);
    if (!given->is_set[index] && !given->is_preset[index])
        settings_put(&given->settings, row, 0);
}

/* Returns whether the scene's objects are ice unless --material says otherwise. */
static bool has_ice(const struct scene *scene)
{
    return scene->has_pool || (scene->model.object_count > 0 && frame_media_are_bare(scene));
}

/* Takes off what is not asked for: cracks and the like of whatever is no ice. */
static void undress(struct app_scene *given, const struct scene *scene)
{
    const bool is_ice =
        given->material ? !strcmp(given->material, material_presets[0].name) : has_ice(scene);
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_of_ice && (given->plain || !is_ice))
            switch_off(given, *t);
    }
    if (given->plain)
        switch_off(given, &surface);
}

/* What the inclusions are made of belongs to one object. */
static void check_inclusions(struct app_scene *given, const struct scene *scene)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        if (scene->model.object_count < 2 || !(*t)->is_of_ice || !(*t)->is_on(&given->settings))
            continue;
        log_warning("%s: left out, because the scene has %u refractive objects",
                    (*t)->title ? (*t)->title : (*t)->name, scene->model.object_count);
        settings_put(&given->settings, &(*t)->settings[0]->rows[0], 0);
    }
}

/* Nothing shows the lights of a file but opaque surfaces. */
static void check_lights(const struct app_scene *given, const struct scene *scene)
{
    if (scene->model.light_count > 0 && !scene->light_rows)
        log_warning("%s: its lights are not seen: they light opaque surfaces that are not unlit, "
                    "and the scene has none",
                    given->name);
}

/* No box is no error: a window's user may be about to say one. */
static void check_box(const struct app_scene *given, const struct scene *scene)
{
    const struct refract_params *refract = settings_of(&given->settings, &refract_settings);
    const struct box box = local_box_of(scene, &given->settings);
    const bool is_box = box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
    if (refract->lookup == REFRACT_LOOKUP_BOX && !is_box)
        log_warning("refract.lookup=box: the box is empty, so the environment is infinitely far "
                    "away; set local.left < right, bottom < top and back < front");
}

enum status app_need_scene(const struct app_scene *given)
{
    if (given->name)
        return STATUS_OK;
    log_error("SCENE is missing: expected a name of firn list scenes or a model file (see --help)");
    return STATUS_USAGE;
}

static bool is_rough(const struct material *material)
{
    return material->roughness > 0.0f;
}

static bool is_thin(const struct material *material)
{
    return !(material->thickness > 0.0f);
}

/* Returns whether a texture that a rung of faces draws has coordinates that it does not have. */
static bool has_second_set(const struct material *material)
{
    static const enum material_texture_use uses[] = { MATERIAL_BASE_COLOR, MATERIAL_TRANSMISSION,
                                                      MATERIAL_NORMAL };

    for (size_t i = 0; i < sizeof(uses) / sizeof(uses[0]); i++) {
        const struct material_texture *texture = &material->textures[uses[i]];
        if (texture->layer > 0 && texture->uv_set > 0)
            return true;
    }
    return false;
}

/* Returns the number of objects in the box of another one: the rungs draw the outer one alone. */
static uint32_t count_inside(const struct model *model)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < model->object_count; i++) {
        const struct box *box = &model->objects[i].box;
        bool is_inside = false;
        for (uint32_t k = 0; k < model->object_count && !is_inside; k++)
            is_inside = k != i && box_contains(&model->objects[k].box, box);
        count += is_inside;
    }
    return count;
}

static void add_count(char *words, size_t size, uint32_t count, const char *name)
{
    const size_t used = strlen(words);
    if (count)
        snprintf(&words[used], size - used, "%s%u %s", used ? ", " : "", count, name);
}

/* Writes what only the rung trace and the reference make of a scene's own materials: "1 rough". */
static void name_undrawn(const struct scene *scene, char *words, size_t size)
{
    static const struct {
        const char *name;
        bool (*is_there)(const struct material *material);
    } kinds[] = { { "rough", is_rough },
                  { "thin-walled", is_thin },
                  { "with textures on a second set of coordinates", has_second_set } };
    const struct model *model = &scene->model;
    words[0] = '\0';
    if (frame_media_are_bare(scene))
        return;
    for (size_t k = 0; k < sizeof(kinds) / sizeof(kinds[0]); k++) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < model->object_count; i++)
            count += kinds[k].is_there(&model->materials[model->objects[i].material]);
        add_count(words, size, count, kinds[k].name);
    }
    add_count(words, size, count_inside(model), "inside others");
}

static void warn_of_materials(const struct app_picture *picture, const struct scene *scene)
{
    char words[160];
    if (!picture->rung->rung.rows || picture->rung->rung.meets_tree)
        return;
    name_undrawn(scene, words, sizeof(words));
    if (words[0])
        log_warning("%s: drawn as smooth solids, each by itself: of %u objects %s; "
                    "--refraction trace draws what they are",
                    picture->scene.name, scene->model.object_count, words);
}

static void warn_of_bubbles(const struct app_picture *picture, const struct scene *scene)
{
    if (!picture->rung->rung.rows || picture->rung->rung.meets_tree)
        return;
    for (uint32_t i = 0; i < scene->bubbles.count; i++) {
        if (bubble_is_sphere(&scene->bubbles.all[i]))
            continue;
        log_warning("bubbles.shape: drawn as spheres of the same volume; --refraction trace draws "
                    "what they are");
        return;
    }
}

/* Returns whether a corner of the surroundings is well inside the box of the first object. */
static bool holds_surroundings(const struct model *model)
{
    const struct box *box = &model->objects[0].box;
    const vec3s middle = box_center(*box);
    const vec3s half = glms_vec3_scale(glms_vec3_sub(box->max, box->min), 0.5f * INNER_SHARE);
    for (uint32_t i = 0; i < model->surroundings.vertex_count; i++) {
        const vec3s at = glms_vec3_sub(model->surroundings.vertices[i].position, middle);
        if (fabsf(at.x) < half.x && fabsf(at.y) < half.y && fabsf(at.z) < half.z)
            return true;
    }
    return false;
}

/* Returns whether the eye is inside an object, as it is turned at motion.time. */
static bool is_eye_inside(const struct scene *scene, const struct settings *settings,
                          const struct camera *camera)
{
    const struct motion_params *motion = settings_of(settings, &motion_settings);
    const struct model *model = &scene->model;
    mat4s world_from_object, world_from_movers;
    if (!camera || scene->has_pool || camera->height > 0.0f)
        return false;
    frame_turn(&(struct frame_view){ .settings = settings }, box_center(scene->box), motion->time,
               &world_from_object, &world_from_movers);
    const vec3s eye = glms_mat4_mulv3(glms_mat4_inv(world_from_object), camera->eye, 1.0f);
    for (uint32_t i = 0; i < model->object_count; i++) {
        if (object_contains(&model->objects[i], &model->object, eye))
            return true;
    }
    return false;
}

/* Writes why maps of one object's front and back are not enough; "": they are. */
static void name_reason(const struct scene *scene, bool is_inside, char *words, size_t size)
{
    const struct model *model = &scene->model;
    char undrawn[160] = "";
    words[0] = '\0';
    if (!model->object_count || scene->has_pool)
        return;
    if (model->object_count > 1)
        snprintf(words, size, "it has %u refractive objects", model->object_count);
    else if (!object_is_closed(&model->objects[0], &model->object))
        snprintf(words, size, "its object is not closed");
    else if (is_inside)
        snprintf(words, size, "the eye is inside its object");
    else if (holds_surroundings(model))
        snprintf(words, size, "something is inside its object");
    else
        name_undrawn(scene, undrawn, sizeof(undrawn));
    if (undrawn[0])
        snprintf(words, size, "bounce leaves out what it has: %s", undrawn);
}

static bool can_trace(const struct model *model)
{
    const uint64_t indices = (uint64_t)model->object.index_count + model->surroundings.index_count;
    const bool is_few =
        model->object_count <= TREE_SHELLS_FEW || model->material_count <= TREE_MEDIA_MAX;
    return is_few && model->object_count <= TREE_SHELLS_MAX && indices / 3 <= TREE_TRIANGLES_MAX;
}

/* Names settings that somebody has given and that rays do not know: they meet smooth surfaces, and
 * cracks as gaps. */
static void warn_of_settings(const struct app_picture *picture)
{
    static const struct {
        const char *name;
        const struct technique *of;
    } unknown[] = {
        { "bump.strength", &bump }, { "cracks.strength", &cracks }, { "cracks.refract", &cracks },
        { "cracks.clip", &cracks }, { "cracks.surface", &cracks },
    };
    const struct app_scene *given = &picture->scene;
    char words[120] = "";
    for (size_t i = 0; i < sizeof(unknown) / sizeof(unknown[0]); i++) {
        const size_t used = strlen(words);
        if (given->is_set[settings_index(settings_find(unknown[i].name))] &&
            unknown[i].of->is_on(&given->settings))
            snprintf(&words[used], sizeof(words) - used, "%s%s", used ? ", " : "", unknown[i].name);
    }
    if (words[0] && picture->rung->rung.meets_tree && !given->quiet)
        log_warning("%s: no effect with --refraction trace", words);
}

/* Names files, and a size, of what is not there, or is not drawn so. */
static void warn_of_files(const struct app_picture *picture, const struct scene *scene)
{
    const struct app_scene *given = &picture->scene;
    const bool meets_tree = picture->rung->rung.meets_tree;
    const bool is_uneven = bump.is_on(&given->settings) && !meets_tree;
    const bool has_more = (scene->bubbles.count || scene->cracks.index_count) && !meets_tree;
    const bool is_scaled = given->is_set[settings_index(settings_find("target.scale"))];

    const struct {
        const char *option, *file;
        bool has_effect;
    } files[] = {
        { "--cracks", given->cracks, scene->cracks.index_count > 0 },
        { "--air", given->air, scene->air.index_count > 0 },
        { "target.scale", is_scaled ? given->name : NULL,
          picture->rung->rung.rows && (scene->air.index_count || has_more) },
        { "--bump", given->bump, is_uneven && !scene->has_pool },
        { "--bump-mask", given->bump_mask, is_uneven && !scene->has_pool },
    };

    for (size_t i = 0; i < sizeof(files) / sizeof(files[0]) && !given->quiet; i++) {
        if (files[i].file && !files[i].has_effect)
            log_warning("%s: no effect, since this picture has nothing of the kind",
                        files[i].option);
    }
}

static void warn_of_outside(const struct app_scene *given, const struct scene *scene)
{
    if (scene->has_pool && given->is_set[settings_index(settings_find("refract.outside"))] &&
        !given->quiet)
        log_warning("refract.outside: no effect in a pool, where water and air are around the ice");
}

/* Names the shadows that a rung leaves out where a file's surroundings are lit. */
static void warn_of_ground(const struct app_picture *picture, const struct scene *scene)
{
    const struct ground_params *ground = settings_of(&picture->scene.settings, &ground_settings);
    const struct technique_rung *rung = &picture->rung->rung;
    if (ground->light == GROUND_TRACED && rung->rows && !rung->meets_tree && scene->material_rows &&
        material_rows_has_lit(&scene->model.surroundings) && !picture->scene.quiet)
        log_note("ground.light=traced: drawn without, as if nothing were in the way of light; "
                 "--refraction trace draws it");
}

void app_choose_rung(struct app_picture *picture, const struct scene *scene,
                     const struct camera *camera)
{
    const bool is_inside = is_eye_inside(scene, &picture->scene.settings, camera);
    char reason[200] = "";
    if (!picture->is_rung_named)
        name_reason(scene, is_inside, reason, sizeof(reason));
    if (!picture->is_rung_named)
        picture->rung = reason[0] && can_trace(&scene->model) ? &refract_trace : &refract_bounce;
    if (reason[0] && picture->rung == &refract_trace && !picture->scene.quiet)
        log_note("%s: drawn with --refraction trace, because %s", picture->scene.name, reason);
    warn_of_materials(picture, scene);
    if (is_inside && picture->rung->rung.rows && !picture->rung->rung.meets_tree)
        log_warning("%s: the eye is inside an object, which %s draws as seen from outside, so "
                    "that it is missing; --refraction trace draws this view",
                    picture->scene.name, picture->rung->rung.name);
    warn_of_ground(picture, scene);
    if (picture->rung->rung.rows && air_is_medium(&picture->scene.settings))
        log_warning("air.model=medium: drawn as planes; --refraction reference draws a medium");
    warn_of_bubbles(picture, scene);
    warn_of_settings(picture);
    warn_of_files(picture, scene);
    warn_of_outside(&picture->scene, scene);
}

/* Whoever made a file may not have meant it to be ice. */
static void note_ice(const struct app_scene *given, const struct scene *scene)
{
    if (!given->quiet && !given->material && !scene_is_known(given->name) && has_ice(scene))
        log_note("%s: has no materials, so it is drawn as ice; for another one, such as glass, "
                 "say --material glass",
                 given->name);
}

struct settling {
    struct app_scene *given;
    struct bump_maps_params *maps;
};

static void settle(void *user, const struct scene *scene, struct scene_params *params)
{
    const struct settling *settling = user;
    note_ice(settling->given, scene);
    undress(settling->given, scene);
    check_inclusions(settling->given, scene);
    *params = app_describe_scene(settling->given, settling->maps);
}

/* --env valley: the built-in landscape, also around a file. */
static bool is_valley(const struct app_scene *given)
{
    return given->environment && asset_is_valley(given->environment);
}

/* A person's file is in the studio, and an asset in its own environment, unless options say what
 * surrounds it. */
static void choose_environment(struct app_scene *given)
{
    const struct asset *scene = asset_find(given->name, ASSET_SCENE);
    const char *name = scene ? scene->environment : "studio";
    const struct asset *environment = name ? asset_find(name, ASSET_ENVIRONMENT) : NULL;
    if (given->environment || given->surroundings || given->background.is_given || !environment ||
        scene_find_builtin(given->name))
        return;
    if (asset_is_there(environment))
        given->environment = environment->name;
    else if (!given->quiet)
        log_note("%s: not found, so the surroundings are the built-in sky; set FIRN_ASSETS to the "
                 "folder of firn's assets",
                 environment->file);
}

/* An asset's own defaults. */
static enum status take_settings(struct app_scene *given)
{
    const struct asset *scene = asset_find(given->name, ASSET_SCENE);
    for (uint32_t i = 0; scene && i < ASSET_SETTING_COUNT && scene->settings[i]; i++) {
        struct settings settings = given->settings;
        const struct setting *row;
        const enum status status = settings_assign(&settings, scene->settings[i], NULL, &row);
        if (status != STATUS_OK)
            return status;
        if (!given->is_set[settings_index(row)] && !given->is_preset[settings_index(row)])
            given->settings = settings;
    }
    return STATUS_OK;
}

struct scene_params app_describe_scene(const struct app_scene *given, struct bump_maps_params *maps)
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
        .place = given->is_placed ? &given->place : NULL,
        .pose = { .animation = is_at_rest ? NULL : given->animation,
                  .is_first = !given->animation },
        .node_materials = given->node_materials,
        .node_material_count = given->node_material_count,
        .environment = is_valley(given) ? NULL : given->environment,
        .environment_turn = given->env_rotate / 360.0f - floorf(given->env_rotate / 360.0f),
        .environment_exposure = given->env_exposure,
        .background = given->background.is_given ? &given->background.value : NULL,
        .is_hidden = given->no_background,
        .object_triangles = object->triangles,
        .landscape_triangles = landscape->triangles,
        .flat = landscape->flat,
        .mover_count = motion->count,
        .air = { planes->count, planes->seed, planes->size, planes->frequency },
        .has_depth = air_is_medium(&given->settings),
        .bubbles = { holes->count, holes->seed, holes->size, holes->shape, holes->stretch },
        .bump = bump.is_on(&given->settings) || frost.is_on(&given->settings) ? maps : NULL,
        .cracks = { sheets->count, sheets->seed, sheets->clip == CRACKS_CLIP_PRECUT,
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
    const struct scene_params params = app_describe_scene(given, &maps);
    return scene_fill(scene, &params);
}

enum status app_fill_failed(const char *lacking)
{
    log_error("%s: out of memory", lacking);
    return STATUS_TRY_AGAIN;
}

enum status app_pose_scene(struct scene *scene, const struct app_scene *given, float time,
                           bool *is_changed)
{
    struct bump_maps_params maps;
    struct scene posed;
    *is_changed = scene->model.animation && (time < scene->time || time > scene->time);
    if (!*is_changed)
        return STATUS_OK;
    struct scene_params params = app_describe_scene(given, &maps);
    struct reader_params reader = given->reader;
    reader.no_warnings = true; /* the first time has said them */
    params.decode = &reader;
    params.before = scene;
    params.pose.time = time;
    params.later = false;
    const enum status status = scene_load(&posed, &params);
    if (status != STATUS_OK)
        return status;
    posed.settled_ior = scene->settled_ior;
    posed.framed = scene->framed;
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
        status = app_fill_failed(lacking);
    if (status != STATUS_OK)
        scene_finish(scene);
    return status;
}

/* Only files can be placed, and move. */
static enum status check_place(const struct app_scene *given)
{
    const char *options = given->is_placed             ? "--up, --scale and --rotate"
                          : given->animation           ? "--animation"
                          : given->node_material_count ? "--material NODE=..."
                                                       : NULL;
    if (!options || !scene_find_builtin(given->name))
        return STATUS_OK;
    log_error("%s: not available for the built-in scene '%s': expected a model file", options,
              given->name);
    return STATUS_USAGE;
}

/* Options of a file that is missing, or is of another kind. */
static enum status check_environment(const struct app_scene *given, const struct scene *scene)
{
    const bool is_turned = fabsf(given->env_rotate) > 0.0f;
    const bool is_exposed = fabsf(given->env_exposure) > 0.0f;
    if ((!given->environment || is_valley(given)) && (is_turned || is_exposed)) {
        log_error("--env-%s: --env is missing", is_turned ? "rotate" : "exposure");
        return STATUS_USAGE;
    }
    if (is_turned && scene->cube.texels) {
        log_error("--env-rotate: not available for a cube: expected an equirectangular picture "
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
    if (app_need_scene(given) != STATUS_OK || check_place(given) != STATUS_OK)
        return STATUS_USAGE;
    if (take_settings(given) != STATUS_OK)
        return STATUS_USAGE;
    choose_environment(given);
    struct scene_params params = app_describe_scene(given, &maps);
    params.settle = settle;
    params.user = &settling;
    enum status status = scene_load(scene, &params);
    if (status == STATUS_OK)
        status = check_environment(given, scene);
    if (status != STATUS_OK) {
        scene_finish(scene);
    } else {
        settle_ior(given, scene);
        check_box(given, scene);
        check_lights(given, scene);
    }
    return status;
}

struct renderer_params app_renderer_params(const struct app_picture *p, struct gpu *gpu,
                                           const struct scene *scene)
{
    return (struct renderer_params){
        .gpu = gpu,
        .scene = scene,
        .settings = &p->scene.settings,
        .rung = p->rung,
        .width = p->width,
        .height = p->height,
        .columns = p->columns,
        .rows = p->rows,
        .filter = p->filter,
        .interleaved = p->interleaved,
        .sharing = p->sharing,
    };
}
