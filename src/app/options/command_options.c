/* command_options.c: setters and defaults of options that few commands accept. */
#include "src/app/options/command_options.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/options/option_values.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/settings/quality.h"
#include "src/settings/scene_settings.h"
#include "src/tech/inclusions/cracks.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/tech/refract/refract.h"
#include "src/tech/techniques.h"

/* ---- firn diff ---- */

enum status option_exposure(const struct option *option, void *at, const char *value)
{
    struct app_diff *diff = at;
    diff->has_exposure =
        option_parse_numbers(value, ',', &diff->exposure, 1) && fabsf(diff->exposure) <= 40.0f;
    return diff->has_exposure ? STATUS_OK : option_refuse(option, value, "stops from -40 to 40");
}

enum status option_fail_above(const struct option *option, void *at, const char *value)
{
    struct app_diff *diff = at;
    const size_t length = strcspn(value, "=");
    float limit;
    for (int i = 0; i < COMPARISON_METRIC_COUNT && value[length]; i++) {
        const char *name = comparison_metric_names[i];
        if (strlen(name) != length || strncmp(name, value, length) != 0 ||
            !option_parse_numbers(value + length + 1, ',', &limit, 1) || limit < 0.0f)
            continue;
        diff->has_limit[i] = true;
        diff->limits[i] = strtod(value + length + 1, NULL);
        return STATUS_OK;
    }
    return option_refuse(option, value,
                         "METRIC=N with METRIC flip, rmse, relmse, mae or angle, and N at least 0");
}

/* ---- firn farm ---- */

/* Adds an option of sbatch, which becomes a line of the generated script. */
enum status option_farm_sbatch(const struct option *option, void *at, const char *value)
{
    struct app_farm *farm = at;
    if (value[0] != '-' || strchr(value, '\n'))
        return option_refuse(option, value, "an sbatch option, which begins with -");
    if (farm->sbatch_count == APP_SBATCH_COUNT)
        return option_refuse_more(option, value, APP_SBATCH_COUNT);
    farm->sbatch[farm->sbatch_count++] = value;
    return STATUS_OK;
}

enum status option_farm_hosts(const struct option *option, void *at, const char *value)
{
    struct app_farm *farm = at;
    if (!value[0] || strchr(value, '\n'))
        return option_refuse(option, value, "host names separated by commas");
    farm->hosts = value;
    return STATUS_OK;
}

/* ---- firn ladder ---- */

enum status option_refraction_models(const struct option *option, void *at, const char *value)
{
    struct app_ladder *ladder = at;
    return option_parse_names(option, OPTION_REFRACTION_MODELS, value, &ladder->refraction_models,
                              NULL);
}

void option_ladder_settings(struct settings *s)
{
    for (const struct technique *const *t = techniques; *t; t++) {
        if ((*t)->is_on && (!(*t)->is_traced || (*t)->is_ice_only))
            techniques_switch_off(s, *t);
    }
    settings_set_value(s, settings_row(&light_settings, offsetof(struct light_params, count)), 0.0);
    settings_set_value(
        s, settings_row(&env_cube_settings, offsetof(struct env_cube_params, dynamic)), 0.0);
    settings_set_value(s, settings_row(&refract_settings, offsetof(struct refract_params, fresnel)),
                       REFRACT_FRESNEL_EXACT);
    settings_set_value(s, settings_row(&refract_settings, offsetof(struct refract_params, lookup)),
                       REFRACT_LOOKUP_DISTANCE);
}

void option_ladder_whole(struct setup_scene *scene)
{
    const struct setting *refract =
        settings_row(&cracks_settings, offsetof(struct cracks_params, refract));
    for (const struct technique *const *t = techniques; *t; t++) {
        const struct setting *row = (*t)->settings ? &(*t)->settings->rows[0] : NULL;
        if ((*t)->is_ice_only && (*t)->is_traced && row)
            settings_put(&scene->settings, row, row->initial, SETTING_DEFAULT);
    }
    settings_put(&scene->settings, refract, CRACKS_REFRACT_GAP, SETTING_DEFAULT);
}

/* ---- firn profile ---- */

enum status option_clock(const struct option *option, void *at, const char *value)
{
    static const enum rg_clock clocks[] = { RG_CLOCK_NONE, RG_CLOCK_EXACT, RG_CLOCK_SUBMITS };

    static const char *const names[] = { "auto", "timestamps", "submits" };
    enum rg_clock *clock = at;
    const int i = option_find_word(names, sizeof(names) / sizeof(names[0]), value);
    if (i < 0)
        return option_refuse(option, value, "auto, timestamps or submits");
    *clock = clocks[i];
    return STATUS_OK;
}

enum status option_sweep(const struct option *option, void *at, const char *value)
{
    struct app_sweeps *sweeps = at;
    if (sweeps->count == APP_SWEEP_COUNT)
        return option_refuse_more(option, value, APP_SWEEP_COUNT);
    sweeps->texts[sweeps->count++] = value;
    return STATUS_OK;
}

/* ---- firn view ---- */

const char *const app_themes[] = { "dark", "light", NULL };

enum status option_present(const struct option *option, void *at, const char *value)
{
    struct setup_window *view = at;
    return gpu_swapchain_mode_find(value, &view->present)
               ? STATUS_OK
               : option_refuse(option, value, "fifo, mailbox or immediate");
}

enum status option_split(const struct option *option, void *at, const char *value)
{
    struct setup_image *image = at;
    image->split = techniques_find_refraction(value);
    return image->split
               ? STATUS_OK
               : option_refuse_name(option, OPTION_REFRACTION_MODELS, value, strlen(value));
}

enum status option_watch(const struct option *option, void *at, const char *value)
{
    struct setup_window *view = at;
    (void)option;
    view->watch = value ? value : "shaders";
    return STATUS_OK;
}

/* ---- the quality level ---- */

static void apply_level(struct setup_image *image, uint32_t level)
{
    image->level_samples = qualities[level].samples;
    image->level_has_smooth_filter = qualities[level].is_smooth;
    quality_apply(&image->scene.settings, level, SETTING_QUALITY);
}

enum status option_quality(const struct option *option, void *at, const char *value)
{
    const char *const names[] = { qualities[0].name, qualities[1].name, qualities[2].name };
    const int level = option_find_word(names, QUALITY_COUNT, value);
    if (level < 0)
        return option_refuse(option, value, "draft, normal or high");
    apply_level(at, (uint32_t)level);
    return STATUS_OK;
}

/* Disables the reconstruction filter of tonemap.resolve with --plain and pixel filters that are no
 * wider than a pixel. */
static void choose_resolve(struct setup_image *image)
{
    struct settings *settings = &image->scene.settings;
    const struct setting *row = settings_find("tonemap.resolve");
    const bool is_narrow = image->is_filter_named && image->filter != PIXEL_FILTER_BLACKMAN_HARRIS;
    if ((image->scene.plain || is_narrow) && settings_source(settings, row) == SETTING_QUALITY)
        settings_put(settings, row, TONEMAP_RESOLVE_WEIGHTED, SETTING_QUALITY);
}

void option_default_quality(struct app_options *o, enum app_command command)
{
    const struct setup_image *image = &o->image;
    const bool has_limit = o->render.noise > 0.0 || o->render.seconds > 0.0;
    const bool has_samples = image->samples && command != APP_VIEW; /* a window has a target */
    if (!image->level_samples && !has_samples && !image->scene.preset && !has_limit)
        apply_level(&o->image, QUALITY_RENDER_DEFAULT);
    choose_resolve(&o->image);
}

/* ---- the path-traced reference ---- */

enum {
    SAMPLES_MAX = 65536 /* default sample count with a noise or time limit */
};

const char *option_sums_image(const struct app_options *o)
{
    for (uint32_t i = 0; i < o->run.outputs.count; i++) {
        if (path_ends_in(o->run.outputs.paths[i], ".exr"))
            return o->run.outputs.paths[i];
    }
    return NULL;
}

char *option_sums_file(const char *image)
{
    static const char ending[] = ".sums.exr";
    const size_t length = strlen(image) - strlen(".exr");
    const size_t size = length + sizeof(ending);
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%.*s%s", (int)length, image, ending);
    return name;
}

enum status option_check_reference(struct app_options *o)
{
    const struct app_render *render = &o->render;
    const char *limit = render->noise > 0.0 ? "noise" : render->seconds > 0.0 ? "time" : NULL;
    const bool is_named = o->image.is_refraction_named;
    const uint32_t default_count = o->image.level_samples ? o->image.level_samples : 1;
    if (o->image.level_has_smooth_filter && !o->image.is_filter_named)
        o->image.filter = PIXEL_FILTER_BLACKMAN_HARRIS;
    if (!o->image.samples)
        o->image.samples = limit ? SAMPLES_MAX : default_count;
    if (o->image.refraction != &cpu_reference_settings && (limit || render->keep_sums)) {
        log_error("--%s: only available with --refraction reference%s%s%s; %s",
                  limit ? limit : "keep-sums", is_named ? ", not '" : "",
                  is_named ? o->image.refraction->refraction.name : "", is_named ? "'" : "",
                  limit ? "give --samples instead" : "leave it out");
        return STATUS_USAGE;
    }
    if (render->keep_sums && !option_sums_image(o)) {
        log_error(
            "--keep-sums: expected an .exr file as --output, beside which the sums are stored");
        return STATUS_USAGE;
    }
    return STATUS_OK;
}
