/* cmd_sheet.c: command firn sheet: draws a contact sheet with one image per value of a setting. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/options/sweep_values.h"
#include "src/app/progress.h"
#include "src/base/log.h"
#include "src/base/shell_quote.h"
#include "src/base/text_stream.h"
#include "src/file/atomic_file.h"
#include "src/file/png.h"
#include "src/lab/ladder/canvas.h"
#include "src/lab/ladder/sheet_grid.h"
#include "src/render/make_frame_request.h"
#include "src/render/renderer.h"
#include "src/scene/material_presets.h"
#include "src/settings/scene_settings.h"
#include "src/version.h"

enum {
    IMAGES_MAX = 64,
    GREY = 34,
    LABEL_SIZE = 256,
};

struct job {
    struct app_options o;
    char *materials; /* default sweep over all materials */
    struct profile_sweep sweep;
    struct gpu gpu;
    struct canvas canvas;
    char *command;
    struct progress progress;
};

/* ---- the images to draw ---- */

/* Adds the default sweep: "material=ice,water,...". */
static enum status sweep_materials(struct job *job)
{
    struct text_stream stream;
    FILE *out = text_stream_open(&stream);
    for (const struct material_preset *m = material_presets; out && m->name; m++)
        fprintf(out, "%s%s", m == material_presets ? "material=" : ",", m->name);
    job->materials = text_stream_close(&stream, NULL);
    if (!job->materials)
        return log_out_of_memory(NULL);
    job->o.sweeps.texts[job->o.sweeps.count++] = job->materials;
    return STATUS_OK;
}

static enum status check(struct job *job)
{
    struct app_options *o = &job->o;
    struct setup_outputs *outputs = &o->run.outputs;
    enum status status = setup_require_scene(&o->image.scene);
    if (status == STATUS_OK)
        status = file_io_check(outputs->paths[0]);
    if (status == STATUS_OK && !o->sweeps.count)
        status = sweep_materials(job);
    if (status == STATUS_OK)
        status = sweep_values_parse(&job->sweep, &o->sweeps, &o->image);
    if (status == STATUS_OK && job->sweep.point_count > IMAGES_MAX) {
        log_error("--sweep: expected at most %d images on a sheet, got %u", IMAGES_MAX,
                  job->sweep.point_count);
        return STATUS_USAGE;
    }
    for (uint32_t i = 0; i < job->sweep.parameter_count && status == STATUS_OK; i++) {
        if (strcmp(job->sweep.parameters[i].name, "size") != 0)
            continue;
        log_error("--sweep %s: all images of a sheet have the same size; set it with --size",
                  o->sweeps.texts[i]);
        status = STATUS_USAGE;
    }
    return status;
}

/* ---- the sheet ---- */

/* Returns the layout of the sheet. With several parameters, each row varies the last parameter. */
static struct sheet_grid grid_of(const struct job *job)
{
    const uint32_t last = job->sweep.parameter_count - 1;
    const uint32_t count = job->sweep.point_count;
    return (struct sheet_grid){
        .columns = last > 0                ? job->sweep.parameters[last].value_count
                   : count < SHEET_COLUMNS ? count
                                           : SHEET_COLUMNS,
        .width = job->o.image.width,
        .height = job->o.image.height,
    };
}

static enum status open_canvas(struct job *job)
{
    const struct sheet_grid grid = grid_of(job);
    const uint32_t width = sheet_width(&grid);
    const uint32_t height = sheet_height(&grid, job->sweep.point_count);
    return canvas_init(&job->canvas, width, height, GREY) ? STATUS_OK : log_out_of_memory(NULL);
}

/* Writes an image's label, such as "cracks.count=2 air.count=0". */
static void write_label(const struct job *job, uint32_t point, char label[static LABEL_SIZE])
{
    size_t length = 0;
    for (uint32_t i = 0; i < job->sweep.parameter_count && length < LABEL_SIZE; i++)
        length += (size_t)snprintf(label + length, LABEL_SIZE - length, "%s%s=%s", i ? " " : "",
                                   job->sweep.parameters[i].name,
                                   profile_sweep_value(&job->sweep, point, i));
}

/* Returns the labels of all images in one string, separated by commas. No label contains a comma.
 * The caller frees the string. If out of memory, returns NULL. */
static char *list_labels(const struct job *job)
{
    struct text_stream stream;
    FILE *out = text_stream_open(&stream);
    for (uint32_t i = 0; out && i < job->sweep.point_count; i++) {
        char label[LABEL_SIZE];
        write_label(job, i, label);
        fprintf(out, "%s%s", i ? "," : "", label);
    }
    return text_stream_close(&stream, NULL);
}

/* Draws an image and its label into the sheet. */
static void place_image(struct job *job, uint32_t point, const struct render_result *result)
{
    const struct canvas image = { job->o.image.width, job->o.image.height, result->rgba };
    const struct sheet_grid grid = grid_of(job);
    const uint32_t x = sheet_left(&grid, point);
    const uint32_t y = sheet_top(&grid, point);
    char label[LABEL_SIZE];
    write_label(job, point, label);
    canvas_draw_text(&job->canvas, x, y, sheet_text_scale(&grid), label);
    canvas_draw_image(&job->canvas, x, y + sheet_label_height(&grid), &image);
}

static enum status draw(struct job *job, const struct setup_image *p, const struct scene *scene,
                        const struct camera *camera, struct render_result *result)
{
    const struct motion_params *motion = settings_of(&p->scene.settings, &motion_settings);
    struct renderer_shot shot = { .camera = *camera, .time = motion->time };
    struct renderer_params params = setup_renderer_params(p, &job->gpu, scene);
    struct renderer *renderer = NULL;
    params.samples = p->samples;
    renderer_set_camera(&params, &shot.camera);
    params.display = true;
    enum status status = renderer_create(&renderer, &params);
    if (status == STATUS_OK)
        status = renderer_render(renderer, &shot, result, NULL, NULL);
    renderer_destroy(renderer);
    return status;
}

static enum status add_image(struct job *job, uint32_t point)
{
    struct setup_image image;
    struct scene scene = { 0 };
    struct camera camera;
    struct render_result result = { 0 };
    enum status status = sweep_values_apply(&job->sweep, point, &job->o.image, &image);
    if (status == STATUS_OK)
        status = setup_load_exposed(&scene, &camera, &image);
    job->o.image.scene.exposure = image.scene.exposure; /* all images have that of the first */
    if (status == STATUS_OK)
        setup_choose_refraction(&image, &scene, &camera);
    if (status == STATUS_OK && !job->gpu.device)
        status = gpu_create(&job->gpu, &job->o.run.gpu);
    if (status == STATUS_OK && point == 0)
        setup_check_rays(&image.scene.settings, &job->gpu);
    if (status == STATUS_OK)
        status = draw(job, &image, &scene, &camera, &result);
    if (status == STATUS_OK)
        place_image(job, point, &result);
    render_result_finish(&result);
    scene_finish(&scene);
    return status;
}

static enum status write_sheet(const struct job *job)
{
    const char *path = job->o.run.outputs.paths[0];
    char *labels = list_labels(job);
    if (!labels)
        return log_out_of_memory(path);
    const struct image_text texts[] = {
        { "firn/version", FIRN_VERSION },
        { "firn/command", job->command },
        { "firn/device", job->gpu.properties.deviceName },
        { SHEET_LABELS, labels },
    };
    const struct png_image_source image = {
        .rgba = job->canvas.rgba,
        .width = job->canvas.width,
        .height = job->canvas.height,
        .texts = texts,
        .text_count = sizeof(texts) / sizeof(texts[0]),
    };
    void *data = NULL;
    size_t size = 0;
    enum status status = png_encode(&image, &data, &size);
    if (status == STATUS_OK)
        status = file_io_write(path, data, size);
    free(data);
    free(labels);
    if (status == STATUS_OK && !job->o.run.quiet)
        fprintf(stderr, "%s: %u images of %ux%u\n", path, job->sweep.point_count,
                job->o.image.width, job->o.image.height);
    return status;
}

static enum status run(struct job *job)
{
    enum status status = check(job);
    if (status == STATUS_OK)
        status = open_canvas(job);
    progress_begin(&job->progress, 1, "images", job->o.run.quiet);
    for (uint32_t i = 0; i < job->sweep.point_count && status == STATUS_OK; i++) {
        progress_show(&job->progress, i, job->sweep.point_count);
        status = add_image(job, i);
        progress_clear(&job->progress);
    }
    if (status == STATUS_OK)
        status = write_sheet(job);
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has logged why */
    return status;
}

enum status app_sheet(const struct app_options *options)
{
    struct job *job = calloc(1, sizeof(*job));
    enum status status = STATUS_TRY_AGAIN;
    if (job) {
        job->o = *options;
        job->command = shell_quote_join(options->run.args);
    }
    if (job && job->command)
        status = run(job);
    else
        log_error("out of memory");
    if (!job)
        return status;
    profile_sweep_finish(&job->sweep);
    gpu_destroy(&job->gpu);
    free(job->canvas.rgba);
    free(job->materials);
    free(job->command);
    free(job);
    return status;
}
