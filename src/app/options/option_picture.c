/* option_picture.c: what options set that say what is drawn, on what, and to where. */
#include "src/app/options/option_picture.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "src/app/layer_picture.h"
#include "src/app/options/option_values.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/reference/reference.h"
#include "src/scene/material.h"
#include "src/tech/refract_reference.h"

static enum status add_output(struct app_options *o, const char *option, const char *value)
{
    if (strcmp(value, "-") != 0 && !path_ends_in(value, ".exr") && !path_ends_in(value, ".png"))
        return option_refuse(option, value, "a file name that ends in .exr or .png, or -");
    if (o->output_count == APP_OUTPUT_COUNT)
        return option_refuse_more(option, value, APP_OUTPUT_COUNT);
    o->outputs[o->output_count++] = value;
    return STATUS_OK;
}

enum status option_output(struct app_options *o, const char *value)
{
    return add_output(o, "output", value);
}

static enum status set_only_output(struct app_options *o, const char *value)
{
    if (o->output_count)
        return option_refuse_more("output", value, 1);
    o->outputs[o->output_count++] = value;
    return STATUS_OK;
}

enum status option_bake_output(struct app_options *o, const char *value)
{
    if (strcmp(value, "-") != 0 && !path_ends_in(value, ".exr"))
        return option_refuse("output", value, "a file name that ends in .exr, or -");
    return set_only_output(o, value);
}

enum status option_sheet_output(struct app_options *o, const char *value)
{
    if (!path_ends_in(value, ".png"))
        return option_refuse("output", value, "a file name that ends in .png");
    return set_only_output(o, value);
}

enum status option_screenshot(struct app_options *o, const char *value)
{
    return add_output(o, "screenshot", value);
}

enum status option_size(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 16384, &o->width, &rest) || *rest != 'x' ||
        !option_parse_count(rest + 1, 1, 16384, &o->height, &rest) || *rest)
        return option_refuse("size", value, "WIDTHxHEIGHT in pixels, 1x1 to 16384x16384");
    return STATUS_OK;
}

/* Of a face, which is square. */
enum status option_bake_size(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 4096, &o->width, &rest) || *rest)
        return option_refuse("size", value, "the side of a cube face in texels, 1 to 4096");
    o->height = o->width;
    return STATUS_OK;
}

enum status option_samples(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 65536, &o->samples, &rest) || *rest)
        return option_refuse("samples", value, "a whole number from 1 to 65536");
    return STATUS_OK;
}

enum {
    TILES_MAX = 16 /* in a row or column */
};

enum status option_tiles(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, TILES_MAX, &o->tile_columns, &rest) || *rest != 'x' ||
        !option_parse_count(rest + 1, 1, TILES_MAX, &o->tile_rows, &rest) || *rest)
        return option_refuse("tiles", value, "COLUMNSxROWS, 1x1 to 16x16");
    return STATUS_OK;
}

enum status option_tile(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, TILES_MAX * TILES_MAX, &o->tile, &rest) || *rest)
        return option_refuse("tile", value, "the number of a tile, from 1 to 256");
    return STATUS_OK;
}

enum status option_interleaved(struct app_options *o, const char *value)
{
    (void)value;
    o->interleaved = true;
    return STATUS_OK;
}

static enum status add_layer(struct app_options *o, const char *name, size_t length)
{
    if (length == 3 && !strncmp(name, "all", 3)) {
        o->all_layers = true;
        return STATUS_OK;
    }
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (strlen(techniques_layer(i)->name) == length &&
            !strncmp(techniques_layer(i)->name, name, length)) {
            o->layers |= 1u << i;
            return STATUS_OK;
        }
    }
    return option_refuse_name("aov", OPTION_LAYERS, name, length);
}

enum status option_aov(struct app_options *o, const char *value)
{
    enum status status = STATUS_OK;
    for (const char *name = value; status == STATUS_OK;) {
        size_t length = strcspn(name, ",");
        status = add_layer(o, name, length);
        if (!name[length])
            break;
        name += length + 1;
    }
    return status;
}

enum status option_show(struct app_options *o, const char *value)
{
    o->show = layer_picture_find(value);
    return o->show ? STATUS_OK : option_refuse_name("show", OPTION_LAYERS, value, strlen(value));
}

enum status option_frames(struct app_options *o, const char *value)
{
    o->frames = value;
    return STATUS_OK;
}

enum status option_chunk(struct app_options *o, const char *value)
{
    enum {
        CHUNKS_MAX = 1000000
    };

    const char *rest;
    const bool ok = option_parse_count(value, 1, CHUNKS_MAX, &o->chunk, &rest) && *rest == '/' &&
                    option_parse_count(rest + 1, 1, CHUNKS_MAX, &o->chunk_count, &rest) && !*rest &&
                    o->chunk <= o->chunk_count;
    return ok ? STATUS_OK : option_refuse("chunk", value, "K/N, K from 1 to N, such as 1/4");
}

enum status option_resume(struct app_options *o, const char *value)
{
    (void)value;
    o->resume = true;
    return STATUS_OK;
}

enum status option_refraction(struct app_options *o, const char *value)
{
    const bool is_traced = !strcmp(value, refract_reference.rung.name);
    o->rung = is_traced ? &refract_reference : techniques_find_rung(value);
    return o->rung
               ? STATUS_OK
               : option_refuse_name("refraction", OPTION_RUNGS_AND_REFERENCE, value, strlen(value));
}

enum status option_material(struct app_options *o, const char *value)
{
    o->material = value;
    return material_find(value)
               ? STATUS_OK
               : option_refuse_name("material", OPTION_MATERIALS, value, strlen(value));
}

enum status option_set(struct app_options *o, const char *value)
{
    static const char ior[] = "refract.ior=";
    o->ior_is_set = o->ior_is_set || !strncmp(value, ior, sizeof(ior) - 1);
    return settings_set(&o->settings, value);
}

enum status option_env(struct app_options *o, const char *value)
{
    o->environment = value;
    return STATUS_OK;
}

enum status option_surroundings(struct app_options *o, const char *value)
{
    o->surroundings = value;
    return STATUS_OK;
}

enum status option_load_seconds(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 3600, &o->load_seconds, &rest) || *rest)
        return option_refuse("load-seconds", value, "a whole number of seconds from 1 to 3600");
    return STATUS_OK;
}

enum status option_load_memory(struct app_options *o, const char *value)
{
    const char *rest;
    if (!option_parse_count(value, 1, 1024, &o->load_memory_gib, &rest) || *rest)
        return option_refuse("load-memory", value, "a whole number of GiB from 1 to 1024");
    return STATUS_OK;
}

enum status option_background(struct app_options *o, const char *value)
{
    o->has_background = option_parse_numbers(value, ',', o->background.raw, 3) &&
                        o->background.x >= 0.0f && o->background.y >= 0.0f &&
                        o->background.z >= 0.0f;
    return o->has_background
               ? STATUS_OK
               : option_refuse("background", value, "R,G,B, linear and each at least 0");
}

/* Metres: so far away squares of distances are finite. */
static const float place_max = 1e9f;

static bool is_place(vec3s v)
{
    return fabsf(v.x) <= place_max && fabsf(v.y) <= place_max && fabsf(v.z) <= place_max;
}

enum status option_orbit(struct app_options *o, const char *value)
{
    o->has_orbit = option_parse_numbers(value, ',', o->orbit.raw, 3) && o->orbit.z > 0.0f &&
                   o->orbit.z <= place_max;
    return o->has_orbit
               ? STATUS_OK
               : option_refuse(
                     "orbit", value,
                     "AZIMUTH,ELEVATION,DISTANCE, in degrees, degrees and metres up to 1e9");
}

enum status option_eye(struct app_options *o, const char *value)
{
    o->has_eye = option_parse_numbers(value, ',', o->eye.raw, 3) && is_place(o->eye);
    return o->has_eye ? STATUS_OK
                      : option_refuse("eye", value, "X,Y,Z in metres, each from -1e9 to 1e9");
}

enum status option_target(struct app_options *o, const char *value)
{
    o->has_target = option_parse_numbers(value, ',', o->target.raw, 3) && is_place(o->target);
    return o->has_target ? STATUS_OK
                         : option_refuse("target", value, "X,Y,Z in metres, each from -1e9 to 1e9");
}

enum status option_fov(struct app_options *o, const char *value)
{
    o->has_fov = option_parse_numbers(value, ',', &o->fov_deg, 1) && o->fov_deg >= 1.0f &&
                 o->fov_deg <= 170.0f;
    return o->has_fov ? STATUS_OK : option_refuse("fov", value, "1 to 170 degrees");
}

enum status option_device(struct app_options *o, const char *value)
{
    o->device = value;
    return STATUS_OK;
}

enum status option_validate(struct app_options *o, const char *value)
{
    (void)value;
    o->validate = true;
    return STATUS_OK;
}

enum status option_no_cache(struct app_options *o, const char *value)
{
    (void)value;
    o->no_cache = true;
    return STATUS_OK;
}

enum status option_sharing(struct app_options *o, const char *value)
{
    static const char *const names[] = {
        [RG_SHARE_FEWEST_BATCHES] = "batches",
        [RG_SHARE_LEAST_MEMORY] = "memory",
        [RG_SHARE_NOTHING] = "nothing",
    };
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        if (!strcmp(value, names[i])) {
            o->sharing = (enum rg_sharing)i;
            return STATUS_OK;
        }
    }
    return option_refuse("sharing", value, "batches, memory or nothing");
}

enum status option_quiet(struct app_options *o, const char *value)
{
    (void)value;
    o->quiet = true;
    return STATUS_OK;
}

/* At most one format; the same one again is harmless. */
static enum status set_format(struct app_options *o, enum app_format format)
{
    static const char *const names[] = {
        [APP_FORMAT_DOT] = "dot",
        [APP_FORMAT_JSON] = "json",
        [APP_FORMAT_HTML] = "html",
    };
    if (o->format != APP_FORMAT_TEXT && o->format != format) {
        log_error("--%s: conflicts with --%s: choose one format", names[format], names[o->format]);
        return STATUS_USAGE;
    }
    o->format = format;
    return STATUS_OK;
}

enum status option_format_dot(struct app_options *o, const char *value)
{
    (void)value;
    return set_format(o, APP_FORMAT_DOT);
}

enum status option_format_json(struct app_options *o, const char *value)
{
    (void)value;
    return set_format(o, APP_FORMAT_JSON);
}

enum status option_format_html(struct app_options *o, const char *value)
{
    (void)value;
    return set_format(o, APP_FORMAT_HTML);
}
