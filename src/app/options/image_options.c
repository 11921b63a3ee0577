/* image_options.c: setters of the options that select scene, image, camera and output files. */
#include "src/app/options/image_options.h"
#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/app/options/node_material_option.h"
#include "src/app/options/option_values.h"
#include "src/base/log.h"
#include "src/lab/reference/reference.h"
#include "src/render/adaptive_sampling.h"
#include "src/scene/material_presets.h"
#include "src/setup/aov_to_png.h"
#include "src/tech/output/tonemap.h"
#include "src/tech/refract/cpu_reference_settings.h"

/* ---- frames and format ---- */

enum status option_chunk(const struct option *option, void *at, const char *value)
{
    enum {
        CHUNKS_MAX = 1000000
    };

    struct app_render *render = at;
    const char *rest;
    const bool ok = option_parse_count(value, 1, CHUNKS_MAX, &render->chunk, &rest) &&
                    *rest == '/' &&
                    option_parse_count(rest + 1, 1, CHUNKS_MAX, &render->chunk_count, &rest) &&
                    !*rest && render->chunk <= render->chunk_count;
    return ok ? STATUS_OK : option_refuse(option, value, "K/N with K from 1 to N, such as 1/4");
}

/* Sets the output format. Refuses a format that contradicts an earlier option. */
enum status option_format(const struct option *option, void *at, const char *value)
{
    static const char *const names[APP_FORMAT_COUNT] = {
        [APP_FORMAT_TEXT] = "",
        [APP_FORMAT_JSON] = "json",
        [APP_FORMAT_HTML] = "html",
        [APP_FORMAT_PRESET] = "preset",
    };
    enum app_format *format = at;
    const enum app_format requested =
        (enum app_format)option_find_word(names, APP_FORMAT_COUNT, option->name);
    (void)value;
    if (*format != APP_FORMAT_TEXT && *format != requested) {
        log_error("--%s: conflicts with --%s: choose one format", names[requested], names[*format]);
        return STATUS_USAGE;
    }
    *format = requested;
    return STATUS_OK;
}

/* ---- size, tiles, layers ---- */

static bool parse_pair(const char *value, uint32_t max, uint32_t *across, uint32_t *down)
{
    const char *rest;
    return option_parse_count(value, 1, max, across, &rest) && *rest == 'x' &&
           option_parse_count(rest + 1, 1, max, down, &rest) && !*rest;
}

enum status option_size(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    return parse_pair(value, 16384, &image->width, &image->height)
               ? STATUS_OK
               : option_refuse(option, value, "WIDTHxHEIGHT in pixels, 1x1 to 16384x16384");
}

enum status option_tiles(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    return parse_pair(value, 16, &image->columns, &image->rows)
               ? STATUS_OK
               : option_refuse(option, value, "COLUMNSxROWS, 1x1 to 16x16");
}

enum status option_aov(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    return option_parse_names(option, OPTION_LAYERS, value, &image->layers, &image->all_layers);
}

enum status option_show(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    image->show = layer_image_find(value);
    return image->show ? STATUS_OK
                       : option_refuse_name(option, OPTION_LAYERS, value, strlen(value));
}

enum status option_ocio(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    const char *comma = strrchr(value, ',');
    if (!comma || comma == value || !comma[1])
        return option_refuse(option, value, "CONFIG,VIEW or CONFIG,DISPLAY/VIEW");
    image->ocio = value;
    return STATUS_OK;
}

enum status option_png_bits(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    const bool is_16 = strcmp(value, "16") == 0;
    if (!is_16 && strcmp(value, "8") != 0)
        return option_refuse(option, value, "8 or 16");
    image->png_bits = is_16 ? 16 : 8;
    return STATUS_OK;
}

enum status option_samples(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    const char *rest;
    image->is_adaptive = strcmp(value, "auto") == 0;
    if (image->is_adaptive)
        image->samples = ADAPTIVE_SAMPLES;
    else if (!option_parse_count(value, 1, 65536, &image->samples, &rest) || *rest)
        return option_refuse(option, value, "a whole number from 1 to 65536, or auto");
    return STATUS_OK;
}

enum status option_pixel_filter(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    const int i = option_find_word(pixel_filter_names, PIXEL_FILTER_COUNT, value);
    if (i < 0)
        return option_refuse(option, value, "box, point or blackman-harris");
    image->filter = (enum pixel_filter)i;
    image->is_filter_named = true;
    return STATUS_OK;
}

/* ---- scene, material, settings ---- */

enum status option_refraction(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    const bool is_traced = !strcmp(value, cpu_reference_settings.refraction.name);
    image->refraction = is_traced ? &cpu_reference_settings : techniques_find_refraction(value);
    image->is_refraction_named = true;
    return image->refraction ? STATUS_OK
                             : option_refuse_name(option, OPTION_REFRACTION_MODELS_AND_REFERENCE,
                                                  value, strlen(value));
}

enum status option_material(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    struct material_choice choice;
    if (strchr(value, '='))
        return option_node_material(option, scene, value);
    scene->material = value;
    return material_choice_parse(&choice, value, strlen(value))
               ? STATUS_OK
               : option_refuse_name(option, OPTION_MATERIALS, value, strlen(value));
}

enum status option_sandbox(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    if (strcmp(value, "on") != 0 && strcmp(value, "off") != 0)
        return option_refuse(option, value, "on or off");
    scene->reader.no_sandbox = value[1] == 'f';
    if (scene->reader.no_sandbox)
        log_warning("--sandbox off: a malicious file can do anything that you can do");
    return STATUS_OK;
}

enum status option_set(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    (void)option;
    scene->exposure.is_set = scene->exposure.is_set ||
                             strncmp(value, "tonemap.exposure=", strlen("tonemap.exposure=")) == 0;
    return settings_assign(&scene->settings, value, SETTING_USER, NULL);
}

/* Sets the tone curve, like --set tonemap.curve. */
enum status option_tone_curve(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    const struct setting *row =
        settings_row(&tonemap_settings, offsetof(struct tonemap_values, curve));
    const int i = option_find_word(row->choices, (int)row->max + 1, value);
    if (i < 0)
        return option_refuse(option, value, "neutral, agx, aces, hable or clip");
    settings_put(&scene->settings, row, i, SETTING_USER);
    return STATUS_OK;
}

/* Sets the exposure, like --set tonemap.exposure, or chooses automatic exposure. */
enum status option_stops(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    const struct setting *row =
        settings_row(&tonemap_settings, offsetof(struct tonemap_values, exposure));
    float stops;
    scene->exposure.is_option = true;
    scene->exposure.is_auto = !strcmp(value, "auto");
    if (scene->exposure.is_auto && reference_is_built())
        return STATUS_OK;
    if (scene->exposure.is_auto) {
        log_error("--exposure auto: this build has no path tracer to meter with (Embree)");
        return STATUS_USAGE;
    }
    if (!option_parse_numbers(value, ',', &stops, 1) || fabs((double)stops) > row->max)
        return option_refuse(option, value, "auto, or stops from -16 to 16");
    settings_put(&scene->settings, row, (double)stops, SETTING_USER);
    return STATUS_OK;
}

enum status option_up(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    scene->has_transform = true;
    scene->model_transform.is_z_up = strcmp(value, "z") == 0;
    return scene->model_transform.is_z_up || strcmp(value, "y") == 0
               ? STATUS_OK
               : option_refuse(option, value, "y or z");
}

enum status option_scale(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    float *scale = &scene->model_transform.scale;
    scene->has_transform = true;
    return option_parse_numbers(value, ',', scale, 1) && *scale >= 1e-6f && *scale <= 1e6f
               ? STATUS_OK
               : option_refuse(option, value, "a number from 1e-6 to 1e6");
}

enum status option_rotate(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    const vec3s *v = &scene->model_transform.rotate_deg;
    scene->has_transform = true;
    const bool ok = option_parse_numbers(value, ',', scene->model_transform.rotate_deg.raw, 3) &&
                    fabsf(v->x) <= 360.0f && fabsf(v->y) <= 360.0f && fabsf(v->z) <= 360.0f;
    return ok ? STATUS_OK : option_refuse(option, value, "X,Y,Z, each from -360 to 360 degrees");
}

/* Sets the background. The value "none" hides it, but an earlier colour still lights the scene. */
enum status option_background(const struct option *option, void *at, const char *value)
{
    struct setup_scene *scene = at;
    struct setup_vector color = { 0 };
    const vec3s *v = &color.value;
    scene->no_background = strcmp(value, "none") == 0;
    if (scene->no_background)
        return STATUS_OK;
    color.is_given = option_parse_numbers(value, ',', color.value.raw, 3) && v->x >= 0.0f &&
                     v->y >= 0.0f && v->z >= 0.0f;
    if (!color.is_given)
        return option_refuse(option, value, "R,G,B, linear and each at least 0, or none");
    scene->background = color;
    return STATUS_OK;
}

enum status option_ground(const struct option *option, void *at, const char *value)
{
    struct stage_params *stage = at;
    vec3s *c = &stage->color;
    const int i = option_find_word(stage_ground_names, STAGE_COLOR, value);
    stage->ground = i < 0 ? STAGE_COLOR : (enum stage_ground)i;
    const bool is_valid = i >= 0 || (option_parse_numbers(value, ',', c->raw, 3) &&
                                     glms_vec3_min(*c) >= 0.0f && glms_vec3_max(*c) <= 1.0f);
    return is_valid ? STATUS_OK
                    : option_refuse(option, value,
                                    "auto, none, shadow, studio, slate, wood, or R,G,B, linear and "
                                    "each from 0 to 1");
}

/* ---- the camera ---- */

/* Maximum coordinate in metres. Its square does not overflow a float. */
static const float position_max = 1e9f;

enum status option_orbit(const struct option *option, void *at, const char *value)
{
    struct setup_vector *orbit = at;
    orbit->is_given = option_parse_numbers(value, ',', orbit->value.raw, 3) &&
                      orbit->value.z > 0.0f && orbit->value.z <= position_max;
    return orbit->is_given
               ? STATUS_OK
               : option_refuse(
                     option, value,
                     "AZIMUTH,ELEVATION,DISTANCE: degrees, degrees, and metres above 0 up to 1e9");
}

enum status option_position(const struct option *option, void *at, const char *value)
{
    struct setup_position *position = at;
    position->is_given = option_parse_doubles(value, ',', position->value, 3);
    for (int k = 0; k < 3; k++)
        position->is_given = position->is_given && fabs(position->value[k]) <= (double)position_max;
    return position->is_given
               ? STATUS_OK
               : option_refuse(option, value, "X,Y,Z in metres, each from -1e9 to 1e9");
}
