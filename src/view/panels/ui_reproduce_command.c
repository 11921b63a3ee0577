/* ui_reproduce_command.c: prints the `firn render` command that reproduces the viewer's image. */
#include "src/view/panels/ui_reproduce_command.h"
#include <cglm/struct.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/shell_quote.h"
#include "src/render/frame/pass_list.h"
#include "src/scene/material_presets.h"
#include "src/scene/scene.h"
#include "src/scene/world_position.h"
#include "src/settings/quality.h"
#include "src/settings/scene_settings.h"
#include "src/tech/refract/refract.h"
#include "src/tech/techniques.h"

static const float roll_tolerance = 1e-4f; /* up-vector difference that counts as roll */

static void print_name(FILE *out, const char *option, const char *name)
{
    if (!name)
        return;
    fprintf(out, " --%s ", option);
    shell_quote_word(name, out);
}

static void print_vector(FILE *out, const char *option, vec3s v)
{
    fprintf(out, " --%s ", option);
    for (int i = 0; i < 3; i++) {
        if (i)
            fputc(',', out);
        settings_print_number(v.raw[i], out);
    }
}

/* Prints a position in the coordinates of the model's file. */
static void print_position(FILE *out, const char *option, const struct model *model, vec3s relative)
{
    if (!world_position_is_far(model)) {
        print_vector(out, option, relative);
        return;
    }
    fprintf(out, " --%s %.15g,%.15g,%.15g", option, world_position_axis(model, relative, 0),
            world_position_axis(model, relative, 1), world_position_axis(model, relative, 2));
}

static void print_given_position(FILE *out, const char *option, const struct model *model,
                                 const struct setup_position *position)
{
    if (position->is_given)
        print_position(out, option, model, world_position_relative(model, position->value));
}

static void print_given(FILE *out, const char *option, const struct setup_vector *vector)
{
    if (vector->is_given)
        print_vector(out, option, vector->value);
}

static void print_fov(FILE *out, float fov_deg)
{
    fputs(" --fov ", out);
    settings_print_number(fov_deg, out);
}

static bool same_camera(const struct camera *a, const struct camera *b)
{
    return glms_vec3_eqv(a->eye, b->eye) && glms_vec3_eqv(a->target, b->target) &&
           glms_vec3_eqv(a->up, b->up) && !(a->fov_deg < b->fov_deg || a->fov_deg > b->fov_deg) &&
           !(a->height < b->height || a->height > b->height);
}

static bool has_roll(const struct camera *camera)
{
    struct camera upright = *camera;
    upright.up = (vec3s){ 0 };
    return glms_vec3_distance(camera_basis(camera).up, camera_basis(&upright).up) > roll_tolerance;
}

/* Prints the initial camera options if the camera still matches them, otherwise eye and target. */
static void print_camera(FILE *out, const struct ui_render_command *c)
{
    const struct setup_image *p = c->image;
    struct camera given;
    if (setup_camera(&given, c->scene, p) == STATUS_OK && same_camera(&given, c->camera)) {
        print_name(out, "camera", p->camera);
        print_given(out, "orbit", &p->orbit);
        print_given_position(out, "eye", &c->scene->model, &p->eye);
        print_given_position(out, "target", &c->scene->model, &p->target);
        if (p->fov_deg > 0.0f)
            print_fov(out, p->fov_deg);
        return;
    }
    if (has_roll(c->camera))
        log_warning("the camera is tilted sideways, which no option of firn render supports: the "
                    "copied view is level");
    if (c->camera->height > 0.0f)
        log_warning("the camera is orthographic and was moved, which no option of firn render "
                    "supports: the copied view is a perspective one");
    print_position(out, "eye", &c->scene->model, c->camera->eye);
    print_position(out, "target", &c->scene->model, c->camera->target);
    print_fov(out, c->camera->fov_deg);
}

static bool differ(double a, double b)
{
    return a < b || a > b;
}

/* Prints an option unless its value is 0. */
static void print_number(FILE *out, const char *option, float value)
{
    if (differ((double)value, 0.0)) {
        fprintf(out, " --%s ", option);
        settings_print_number(value, out);
    }
}

static void print_setting(FILE *out, const struct settings *settings, const struct setting *row)
{
    fprintf(out, " --set %s=", row->name);
    settings_print(settings, row, out);
}

/* Prints options for the refractive index if it differs from the scene's own index. For model
 * files, always prints a given --material, because it also selects the model's refractive parts. */
static void print_ior(FILE *out, const struct ui_render_command *c)
{
    const struct setting *row =
        settings_row(&refract_settings, offsetof(struct refract_params, ior));
    const struct model *model = &c->scene->model;
    const struct settings defaults = settings_default();
    const char *material = c->image->scene.material;
    const double ior = settings_get(&c->image->scene.settings, row);
    double own = model->has_ior ? (double)model->ior : settings_get(&defaults, row);
    struct material_choice choice;
    if (material && !scene_find_builtin(c->image->scene.name) &&
        material_choice_parse(&choice, material, strlen(material))) {
        print_name(out, "material", material);
        own = (double)choice.preset->ior;
    }
    if (differ(ior, own))
        print_setting(out, &c->image->scene.settings, row);
}

/* Prints the quality level, the settings that differ from it, and the exposure of a model file,
 * which would be metered otherwise. Dithering that only the level sets is switched off, because
 * windows do not dither. */
static void print_settings(FILE *out, const struct ui_render_command *c)
{
    const struct settings defaults = settings_default();
    const struct settings scene_settings = setup_scene_settings(&c->image->scene, c->scene);
    const struct setting *dither = settings_find("tonemap.dither");
    const struct setting *resolve = settings_find("tonemap.resolve");
    struct settings settings = frame_settings(&c->image->scene.settings, c->scene);
    struct settings of_level = defaults;
    const uint32_t level = quality_nearest(&settings);
    quality_apply(&of_level, level, SETTING_QUALITY);
    const bool has_level = level != quality_nearest(&defaults);
    const struct setting *metered =
        scene_find_builtin(c->image->scene.name) ? NULL : settings_find("tonemap.exposure");
    if (c->image->filter != PIXEL_FILTER_BLACKMAN_HARRIS && settings_get(&of_level, resolve) > 0.0)
        settings_set_value(&of_level, resolve, TONEMAP_RESOLVE_WEIGHTED);
    if (has_level)
        print_name(out, "quality", qualities[level].name);
    if (c->image->filter != PIXEL_FILTER_BOX || (has_level && qualities[level].is_smooth))
        print_name(out, "pixel-filter", pixel_filter_names[c->image->filter]);
    settings_set_value(&settings, settings_find("motion.time"), (double)c->time);
    if (settings_source(&settings, dither) == SETTING_QUALITY)
        settings_set_value(&settings, dither, 0.0);
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        if (row != settings_row(&refract_settings, offsetof(struct refract_params, ior)) &&
            (row == metered || differ(settings_get(&settings, row), settings_get(&of_level, row)) ||
             differ(settings_get(&scene_settings, row), settings_get(&defaults, row))))
            print_setting(out, &settings, row);
    }
}

/* Prints the options that transform and hide single objects. */
static void print_object_transforms(FILE *out, const struct setup_scene *scene)
{
    char words[SETUP_TRANSFORM_SIZE];
    for (uint32_t i = 0; i < scene->object_transform_count; i++) {
        const struct object_transform *t = &scene->object_transforms[i];
        if (setup_print_transform(t, words))
            print_name(out, "transform", words);
        print_name(out, "hide", t->is_hidden ? t->name : NULL);
    }
}

static void print(FILE *out, const struct ui_render_command *c)
{
    const struct setup_image *p = c->image;
    fputs("firn render ", out);
    if (p->scene.name[0] == '-') /* otherwise the name would be parsed as an option */
        fputs("./", out);
    shell_quote_word(p->scene.name, out);
    fprintf(out, " --size %ux%u", p->width, p->height);
    fprintf(out, " --samples %u", p->samples);
    if (p->is_refraction_named)
        print_name(out, "refraction", p->refraction->refraction.name);
    print_ior(out, c);
    print_settings(out, c);
    if (p->scene.model_transform.is_z_up)
        print_name(out, "up", "z");
    print_number(out, "scale", p->scene.model_transform.scale);
    print_given(out, "rotate",
                &(struct setup_vector){ glms_vec3_norm2(p->scene.model_transform.rotate_deg) > 0.0f,
                                        p->scene.model_transform.rotate_deg });
    for (uint32_t i = 0; i < p->scene.material_override_count; i++)
        print_name(out, "material", p->scene.material_overrides[i].words);
    print_object_transforms(out, &p->scene);
    print_name(out, "animation", p->scene.animation);
    print_name(out, "env", p->scene.environment);
    print_number(out, "env-rotate", p->scene.env_rotate);
    print_number(out, "env-exposure", p->scene.env_exposure);
    print_name(out, "surroundings", p->scene.surroundings);
    char ground[SETUP_GROUND_NAME_SIZE];
    if (stage_has_floor(&p->scene.stage))
        print_name(out, "ground", setup_ground_name(&p->scene.stage, ground));
    print_name(out, "cracks", p->scene.cracks);
    print_name(out, "bump", p->scene.bump);
    print_name(out, "bump-mask", p->scene.bump_mask);
    print_name(out, "air", p->scene.air);
    print_given(out, "background", &p->scene.background);
    print_name(out, "background", p->scene.no_background ? "none" : NULL);
    print_camera(out, c);
    fputs(" -o firn.png", out);
}

char *ui_render_command_print(const struct ui_render_command *command)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    bool ok = out != NULL;
    if (out) {
        print(out, command);
        ok = !ferror(out);
        ok = !fclose(out) && ok;
    }
    if (ok)
        return text;
    log_error("out of memory");
    free(text);
    return NULL;
}
