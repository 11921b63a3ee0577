/* choose_stage.c: chooses the floor of --ground, and its panorama and lights. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include "src/base/log.h"
#include "src/scene/bundled_assets.h"
#include "src/settings/scene_settings.h"
#include "src/setup/setup.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/tech/trace/trace_settings.h"
#include "src/tech/water/caustics.h"

/* Angular diameter of the stage's key light, degrees. */
#define STAGE_LIGHT_DEG 3.0

/* Photons of the reference; the default number takes longer than a small image. */
#define STAGE_PHOTONS 500000.0

static const char stage_environment[] = "stage";

/* Returns true if the user has chosen what is around the object. */
static bool has_given_surroundings(const struct setup_scene *options)
{
    const bool has_environment = options->environment && !options->has_default_environment;
    return has_environment || options->surroundings || options->background.is_given ||
           options->no_background;
}

struct stage_params setup_stage(const struct setup_scene *options, const struct model *model)
{
    struct stage_params stage = options->ground;
    if (stage.ground != STAGE_AUTO)
        return stage;
    const bool is_bare = !scene_is_known(options->name) && !options->plain &&
                         !has_given_surroundings(options) && !stage_has_own_surroundings(model);
    stage.ground = is_bare ? STAGE_STUDIO : STAGE_NONE;
    return stage;
}

const char *setup_ground_name(const struct stage_params *stage,
                              char text[static SETUP_GROUND_NAME_SIZE])
{
    const vec3s *c = &stage->color;
    if (stage->ground != STAGE_COLOR)
        return stage_ground_names[stage->ground];
    snprintf(text, SETUP_GROUND_NAME_SIZE, "%.9g,%.9g,%.9g", (double)c->x, (double)c->y,
             (double)c->z);
    return text;
}

enum status setup_check_ground(const struct setup_scene *options)
{
    if (!stage_has_floor(&options->ground) || !scene_find_builtin(options->name))
        return STATUS_OK;
    log_error("--ground: not available for the built-in scene '%s': expected a model file",
              options->name);
    return STATUS_USAGE;
}

bool setup_is_stage_environment(const char *scene, const char *environment)
{
    return scene && environment && !strcmp(environment, stage_environment) &&
           !scene_is_known(scene);
}

/* Returns true if rays that leave the model's only object hit nothing but the floor, which the
 * environment cube shows as well, in less time. */
static bool is_bare(const struct model *model)
{
    return model->object_count == 1 && !model->surroundings.index_count &&
           !material_is_textured(&model->materials[model->objects[0].material]) &&
           model->materials[model->objects[0].material].transmission >= 1.0f &&
           !(model->materials[model->objects[0].material].scattering_optical_depth > 0.0f);
}

const struct asset *setup_default_environment(const char *name)
{
    const struct asset *scene = asset_find(name, ASSET_SCENE);
    const char *asset = scene ? scene->environment : scene_find_builtin(name) ? NULL : "studio";
    return asset ? asset_find(asset, ASSET_ENVIRONMENT) : NULL;
}

/* Replaces the default panorama by that of the stage, or restores it. */
static void choose_environment(struct setup_scene *options)
{
    const struct asset *asset = stage_has_floor(&options->stage)
                                    ? asset_find(stage_environment, ASSET_ENVIRONMENT)
                                    : setup_default_environment(options->name);
    if (options->has_default_environment && asset && asset_exists(asset))
        options->environment = asset->name;
}

void setup_choose_stage(struct setup_scene *options, const struct scene *scene)
{
    options->stage = setup_stage(options, &scene->model);
    options->is_stage_bare = is_bare(&scene->model);
    choose_environment(options);
}

void setup_choose_stage_settings(struct setup_scene *options)
{
    const struct setting *sun =
        settings_row(&caustics_settings, offsetof(struct caustics_params, sun));
    const struct setting *hits =
        settings_row(&trace_settings, offsetof(struct trace_params, surroundings));
    const struct setting *photons =
        settings_row(&reference_settings, offsetof(struct reference_params, photons));
    if (!stage_has_floor(&options->stage))
        return;
    settings_put(&options->settings, photons, STAGE_PHOTONS, SETTING_SCENE);
    if (options->has_default_environment)
        settings_put(&options->settings, sun, STAGE_LIGHT_DEG, SETTING_SCENE);
    if (options->is_stage_bare)
        settings_put(&options->settings, hits, TRACE_CUBE, SETTING_SCENE);
}
