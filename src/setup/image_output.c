/* image_output.c: encodes images as EXR and PNG files with metadata, and recognises up-to-date
 * files. */
#include "src/setup/image_output.h"
#include <cglm/struct.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/base/text_stream.h"
#include "src/base/tile.h"
#include "src/file/atomic_file.h"
#include "src/file/cryptomatte.h"
#include "src/file/exr.h"
#include "src/file/png.h"
#include "src/lab/reference/reference.h"
#include "src/render/frame/frame_uniforms.h"
#include "src/render/frame/pass_list.h"
#include "src/scene/world_position.h"
#include "src/settings/scene_settings.h"
#include "src/setup/aov_to_png.h"
#include "src/setup/object_id_names.h"
#include "src/tech/refract/cpu_reference_settings.h"
#include "src/version.h"

/* Maximum number of metadata texts. */
enum {
    TEXT_COUNT_MAX = 9 + 2 * CRYPTOMATTE_TEXTS
};

/* Metadata texts of a file. --resume compares only the first compared_count texts. */
struct texts {
    struct image_text all[TEXT_COUNT_MAX];
    uint32_t count, compared_count;
    char tile[32], samples[16], noise[32], origin[96];
};

/* ---- metadata ---- */

static void print_vector(FILE *out, const char *name, vec3s v)
{
    fprintf(out, " %s=%.9g,%.9g,%.9g", name, (double)v.x, (double)v.y, (double)v.z);
}

/* Prints a position in the coordinates of the model's file. */
static void print_position(FILE *out, const char *name, const struct model *model, vec3s relative)
{
    const int digits = world_position_digits(model, 9);
    fprintf(out, " %s=%.*g,%.*g,%.*g", name, digits, world_position_axis(model, relative, 0),
            digits, world_position_axis(model, relative, 1), digits,
            world_position_axis(model, relative, 2));
}

static void print_settings(FILE *out, const struct settings *settings)
{
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        fprintf(out, " %s=", row->name);
        settings_print(settings, row, out);
    }
}

/* Prints the scene time, in seconds, at which a static environment cube is drawn. */
static void print_cube_time(FILE *out, const struct settings *settings, const struct scene *scene)
{
    const struct motion_params *motion = settings_of(settings, &motion_settings);
    if (!frame_draws_cube(settings, scene))
        fprintf(out, " cube_time=%.9g", (double)motion->time);
}

static void print_transform(FILE *out, const struct setup_scene *scene)
{
    const struct model_transform *model_transform = &scene->model_transform;
    char words[SETUP_TRANSFORM_SIZE];
    if (model_transform->is_z_up)
        fputs(" up=z", out);
    if (model_transform->scale > 0.0f)
        fprintf(out, " scale=%.9g", (double)model_transform->scale);
    if (glms_vec3_norm2(model_transform->rotate_deg) > 0.0f)
        print_vector(out, "rotate", model_transform->rotate_deg);
    /* --material turns a model without transmissive materials into one refractive object */
    if (scene->material && !scene_find_builtin(scene->name))
        fprintf(out, " material=%s", scene->material);
    for (uint32_t i = 0; i < scene->material_override_count; i++)
        fprintf(out, " material=%s", scene->material_overrides[i].words);
    for (uint32_t i = 0; i < scene->object_transform_count; i++) {
        if (setup_print_transform(&scene->object_transforms[i], words))
            fprintf(out, " transform=%s", words);
        if (scene->object_transforms[i].is_hidden)
            fprintf(out, " hide=%s", scene->object_transforms[i].name);
    }
    if (scene->animation)
        fprintf(out, " animation=%s", scene->animation);
}

static void print_surroundings(FILE *out, const struct setup_scene *scene)
{
    if (scene->environment)
        fprintf(out, " env=%s", scene->environment);
    if (scene->env_rotate < 0.0f || scene->env_rotate > 0.0f)
        fprintf(out, " env-rotate=%.9g", (double)scene->env_rotate);
    if (scene->env_exposure < 0.0f || scene->env_exposure > 0.0f)
        fprintf(out, " env-exposure=%.9g", (double)scene->env_exposure);
    if (scene->surroundings)
        fprintf(out, " surroundings=%s", scene->surroundings);
    char ground[SETUP_GROUND_NAME_SIZE];
    if (stage_has_floor(&scene->stage))
        fprintf(out, " ground=%s", setup_ground_name(&scene->stage, ground));
    const char *const files[][2] = { { "cracks", scene->cracks },
                                     { "bump", scene->bump },
                                     { "bump-mask", scene->bump_mask },
                                     { "air", scene->air } };
    for (size_t i = 0; i < sizeof(files) / sizeof(files[0]); i++) {
        if (files[i][1])
            fprintf(out, " %s=%s", files[i][0], files[i][1]);
    }
    if (scene->background.is_given)
        print_vector(out, "background", scene->background.value);
    if (scene->no_background)
        fputs(" background=none", out);
}

/* Prints the options that change only PNG files. */
static void print_png_options(FILE *out, const struct setup_image *p)
{
    if (p->show)
        fprintf(out, " show=%s", p->show->name);
    if (p->ocio)
        fprintf(out, " ocio=%s", p->ocio);
    if (p->png_bits == 16)
        fputs(" png-bits=16", out);
}

static bool describe(const struct output *output, bool is_png, char **text)
{
    const struct setup_image *p = output->image;
    const struct camera *camera = &output->shot.camera;
    struct settings settings =
        frame_resolve_settings(&p->scene.settings, output->scene, p->refraction, p->height);
    struct text_stream stream;
    FILE *out = text_stream_open(&stream);

    settings_set_value(&settings, settings_find("motion.time"), (double)output->shot.time);
    if (out) {
        fprintf(out, "scene=%s refraction=%s size=%ux%u samples=", p->scene.name,
                p->refraction->refraction.name, p->width, p->height);
        if (p->is_adaptive)
            fputs("auto", out);
        else
            fprintf(out, "%u", output->samples ? output->samples : p->samples);
        if (p->filter != PIXEL_FILTER_BOX)
            fprintf(out, " pixel-filter=%s", pixel_filter_names[p->filter]);
        if (p->interleaved) /* other tiles do not change pixels */
            fprintf(out, " interleaved=%ux%u", p->columns, p->rows);
        if (p->split)
            fprintf(out, " split=%s", p->split->refraction.name);
        if (is_png)
            print_png_options(out, p);
        print_transform(out, &p->scene);
        print_surroundings(out, &p->scene);
        if (p->camera)
            fprintf(out, " camera=%s", p->camera);
        print_position(out, "eye", &output->scene->model, camera->eye);
        print_position(out, "target", &output->scene->model, camera->target);
        if (camera->height > 0.0f)
            fprintf(out, " height=%.9g", (double)camera->height);
        fprintf(out, " fov=%.9g", (double)camera->fov_deg);
        print_settings(out, &settings);
        print_cube_time(out, &p->scene.settings, output->scene);
    }
    *text = text_stream_close(&stream, NULL);
    return *text;
}

enum status output_describe(struct output *output)
{
    output_finish(output);
    bool ok =
        describe(output, false, &output->settings) && describe(output, true, &output->png_settings);
    if (!ok)
        log_error("out of memory");
    return ok ? STATUS_OK : STATUS_TRY_AGAIN;
}

void output_finish(struct output *output)
{
    free(output->settings);
    free(output->png_settings);
    output->settings = output->png_settings = NULL;
}

static void add_text(struct texts *texts, const char *name, const char *value)
{
    texts->all[texts->count++] = (struct image_text){ name, value };
}

static void fill_texts(struct texts *texts, const struct output *output, bool is_png,
                       const char *device)
{
    const struct setup_image *p = output->image;
    texts->count = 0;
    add_text(texts, "firn/version", FIRN_VERSION);
    add_text(texts, "firn/settings", is_png ? output->png_settings : output->settings);
    if (p->tile) {
        snprintf(texts->tile, sizeof(texts->tile), "%u of %ux%u%s", p->tile, p->columns, p->rows,
                 p->interleaved ? " interleaved" : "");
        add_text(texts, "firn/tile", texts->tile);
    }
    texts->compared_count = texts->count;
    add_text(texts, "firn/device", device);
    if (world_position_is_far(&output->scene->model)) {
        const double *origin = output->scene->model.origin;
        snprintf(texts->origin, sizeof(texts->origin), "%.15g,%.15g,%.15g", origin[0], origin[1],
                 origin[2]);
        add_text(texts, "firn/origin", texts->origin);
    }
    if (!output->samples)
        return;
    snprintf(texts->samples, sizeof(texts->samples), "%u", output->samples);
    snprintf(texts->noise, sizeof(texts->noise), "%.9g", output->noise);
    add_text(texts, "firn/samples", texts->samples);
    add_text(texts, "firn/noise", texts->noise);
}

/* Returns the rectangle of the image that a file contains. Interleaved tiles are at (0, 0). */
static struct tile pixels_of(const struct setup_image *p)
{
    const struct tiling tiling = { p->width, p->height, p->columns, p->rows };
    if (!p->tile)
        return (struct tile){ .width = p->width, .height = p->height };
    if (!p->interleaved)
        return tile_at(&tiling, p->tile - 1);
    return (struct tile){
        .width = p->width / p->columns,
        .height = p->height / p->rows,
    };
}

/* Returns a rectangular tile's position and the whole image's size, or zeros for other files. */
static struct image_window window_of(const struct setup_image *p)
{
    const struct tile tile = pixels_of(p);
    if (!p->tile || p->interleaved)
        return (struct image_window){ 0 };
    return (struct image_window){ tile.x, tile.y, p->width, p->height };
}

/* Checks that the image size can be divided into the tiles. Returns an error message, or NULL. */
static const char *check_sizes(const struct setup_image *p)
{
    const struct tiling tiling = { p->width, p->height, p->columns, p->rows };
    if (!p->interleaved)
        return tile_fits(&tiling) ? NULL
                                  : "--tiles: expected at least 2x2 pixels per tile; increase "
                                    "--size or use fewer tiles";
    if (p->width % p->columns || p->height % p->rows)
        return "--interleaved: expected a --size that is a multiple of the columns and rows of "
               "--tiles";
    return NULL;
}

enum status output_check_tiles(const struct setup_image *p, const struct setup_outputs *outputs)
{
    const char *wrong = NULL;
    if (p->is_adaptive && (p->columns || p->refraction == &cpu_reference_settings)) {
        wrong = p->columns ? "--samples auto: not available with --tiles, since it depends on the "
                             "whole image; give a number"
                           : "--samples auto: not available with --refraction reference; give "
                             "--noise, or a number";
    } else if (!p->columns && (p->tile || p->interleaved)) {
        wrong = p->tile ? "--tile: --tiles is missing" : "--interleaved: --tiles is missing";
    } else if (p->columns) {
        if (p->refraction == &cpu_reference_settings)
            wrong = "--tiles: not available with --refraction reference, which needs no tiles";
        else if (p->tile > p->columns * p->rows)
            wrong = "--tile: its number exceeds the number of --tiles";
        else
            wrong = check_sizes(p);
        for (uint32_t i = 0; i < outputs->count && p->tile && !wrong; i++)
            wrong = path_ends_in(outputs->paths[i], ".png")
                        ? "--tile: expected an .exr file as --output, got a .png"
                        : NULL;
    }
    if (!wrong)
        return STATUS_OK;
    log_error("%s", wrong);
    return STATUS_USAGE;
}

/* ---- existing files ---- */

enum {
    PLANE_COUNT_MAX = FRAME_LAYER_PLANES * (FRAME_LAYER_MAX + 1)
};

static void add_layer(struct image *image, const struct frame_layer *layer)
{
    for (uint32_t i = 0; i < frame_layer_plane_count(layer); i++) {
        struct image_plane *plane = &image->planes[image->plane_count++];
        plane->half = layer->half;
        plane->integer = layer->integer;
        snprintf(plane->name, sizeof(plane->name), "%s", layer->planes[i]);
    }
}

static bool exr_is_current(const struct output *output, const struct image_header *head,
                           const struct texts *texts)
{
    const struct setup_image *p = output->image;
    struct image_plane planes[PLANE_COUNT_MAX] = { 0 };
    const struct tile tile = pixels_of(p);
    struct image image = { .width = tile.width, .height = tile.height, .planes = planes };
    const struct exr_header header = {
        .texts = texts->all,
        .text_count = texts->compared_count,
        .window = window_of(p),
    };

    add_layer(&image, &frame_beauty);
    for (uint32_t i = 0; techniques_layer(i); i++) {
        if (p->layers & UINT64_C(1) << i)
            add_layer(&image, techniques_layer(i));
    }
    return exr_matches(head, &image, &header);
}

/* Returns true if PNG files have an alpha channel. */
static bool has_alpha(const struct setup_image *p)
{
    return p->scene.no_background && !p->show;
}

bool output_is_current(const struct output *output, const char *path,
                       const struct image_header *head)
{
    struct texts texts;
    const bool is_png = path_ends_in(path, ".png");
    fill_texts(&texts, output, is_png, "");
    const struct png_image_source image = {
        .width = pixels_of(output->image).width,
        .height = pixels_of(output->image).height,
        .texts = texts.all,
        .text_count = texts.compared_count,
        .has_alpha = has_alpha(output->image),
    };
    return is_png ? png_matches(head, &image) : exr_is_current(output, head, &texts);
}

uint32_t output_enough_samples(const struct image_header *head, uint32_t samples, double noise)
{
    const char *count = image_header_text(head, "firn/samples");
    const char *level = image_header_text(head, "firn/noise");
    const unsigned long drawn = count ? strtoul(count, NULL, 10) : 0;
    const bool is_exact = level && noise > 0.0 && strtod(level, NULL) <= noise;
    return drawn && drawn <= samples && (drawn == samples || is_exact) ? (uint32_t)drawn : 0;
}

/* ---- new files ---- */

/* Copies the planes to be written. A layer that was drawn only for --show is left out. */
static void select_planes(struct image *image, const struct image *drawn,
                          const struct setup_image *p)
{
    const bool leave_out = p->show && !(p->layers & layer_image_bit(p->show));
    for (uint32_t i = 0; i < drawn->plane_count; i++) {
        bool keep = true;
        for (uint32_t n = 0; leave_out && n < frame_layer_plane_count(p->show); n++)
            keep = keep && strcmp(drawn->planes[i].name, p->show->planes[n]) != 0;
        if (keep)
            image->planes[image->plane_count++] = drawn->planes[i];
    }
}

static enum status encode_exr(const struct output *output, const struct render_result *result,
                              const struct texts *texts, void **data, size_t *size)
{
    const struct setup_image *p = output->image;
    const struct camera *camera = &output->shot.camera;
    const mat4s view = camera_view_from_world(camera);
    const mat4s ndc = camera_clip_from_world(
        camera, p->width, p->height, scene_near_plane(output->scene), (vec2s){ { 0.0f, 0.0f } });
    const struct motion_params *motion = settings_of(&p->scene.settings, &motion_settings);
    const struct exr_header header = {
        .texts = texts->all,
        .text_count = texts->count,
        .frames_per_second = output->is_frame ? (double)motion->fps : 0.0,
        /* cglm matrices have the memory layout of EXR's row-major matrices for row vectors */
        .world_to_camera = &view.raw[0][0],
        .world_to_ndc = &ndc.raw[0][0],
        .window = window_of(p),
    };
    const struct tile tile = pixels_of(p);
    struct image_plane planes[PLANE_COUNT_MAX];
    struct image image = { .width = tile.width, .height = tile.height, .planes = planes };
    select_planes(&image, &result->image, p);
    return exr_encode(&image, &header, data, size);
}

/* Names of the IDs in an image. */
struct names {
    char *objects, *materials;
    struct cryptomatte_texts object_matte, material_matte;
};

static void add_matte(struct texts *texts, const struct cryptomatte_texts *matte)
{
    for (size_t i = 0; i < CRYPTOMATTE_TEXTS; i++)
        add_text(texts, matte->all[i].name, matte->all[i].value);
}

/* Adds the names of the IDs in the image. The caller calls names_finish(). Returns false when out
 * of memory. */
static bool add_names(struct texts *texts, const struct scene *scene, const struct image *image,
                      struct names *names)
{
    const bool has_object_matte = image_find(image, "CryptoObject00.R");
    const bool has_material_matte = image_find(image, "CryptoMaterial00.R");
    const bool has_objects = has_object_matte || image_find(image, "object.Z") ||
                             image_find(image, "objects.0") ||
                             image_find(image, "refracted.object.Z");
    const bool has_materials = has_material_matte || image_find(image, "material.Z");
    if (has_objects && (names->objects = object_names(scene)))
        add_text(texts, "firn/objects", names->objects);
    if (has_materials && (names->materials = material_names(scene)))
        add_text(texts, "firn/materials", names->materials);
    bool done = (names->objects || !has_objects) && (names->materials || !has_materials);
    if (done && has_object_matte) {
        done = cryptomatte_describe(&names->object_matte, "CryptoObject", names->objects);
        add_matte(texts, &names->object_matte);
    }
    if (done && has_material_matte) {
        done = cryptomatte_describe(&names->material_matte, "CryptoMaterial", names->materials);
        add_matte(texts, &names->material_matte);
    }
    return done;
}

static void names_finish(struct names *names)
{
    free(names->objects);
    free(names->materials);
    cryptomatte_finish(&names->object_matte);
    cryptomatte_finish(&names->material_matte);
}

enum status output_encode(const struct output *output, const char *path,
                          const struct render_result *result, const char *device, void **data,
                          size_t *size)
{
    struct texts texts;
    const bool is_png = path_ends_in(path, ".png");
    struct names names = { 0 };
    fill_texts(&texts, output, is_png, device);
    if (!is_png && !add_names(&texts, output->scene, &result->image, &names)) {
        names_finish(&names);
        return log_out_of_memory("names");
    }
    const struct png_image_source image = {
        .rgba = result->rgba,
        .width = pixels_of(output->image).width,
        .height = pixels_of(output->image).height,
        .texts = texts.all,
        .text_count = texts.count,
        .rgba_16 = result->rgba_16,
        .has_alpha = has_alpha(output->image),
    };
    const enum status status =
        is_png ? png_encode(&image, data, size) : encode_exr(output, result, &texts, data, size);
    names_finish(&names);
    return status;
}
