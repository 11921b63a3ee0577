/* cmd_diff.c: command firn diff: measures the differences between two images. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/diff_report.h"
#include "src/app/input_image.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/file/atomic_file.h"
#include "src/file/exr.h"
#include "src/file/png.h"
#include "src/lab/metric/heat_map.h"

struct job {
    const struct app_options *options;
    struct image reference, test;
    bool is_display; /* both images are display-referred (PNG) */
    bool *counted;   /* compared pixels; NULL: all */
    struct comparison comparison;
    struct diff_report report;
};

/* ---- images ---- */

static enum status check_size(const struct job *job, const struct image *other, const char *path)
{
    return input_image_check_size(&job->reference, job->options->positionals[0], other, path);
}

static enum status read_images(struct job *job)
{
    const char *const *paths = job->options->positionals;
    const struct reader_params *params = &job->options->image.scene.reader;
    enum status status = input_image_read(paths[0], params, &job->reference);
    if (status == STATUS_OK)
        status = input_image_read(paths[1], params, &job->test);
    return status == STATUS_OK ? check_size(job, &job->test, paths[1]) : status;
}

static enum status read_mask(struct job *job)
{
    const struct app_mask *mask = &job->options->mask;
    struct image image = { 0 };
    enum status status = input_image_read(mask->file, &job->options->image.scene.reader, &image);
    if (status == STATUS_OK)
        status = check_size(job, &image, mask->file);
    if (status == STATUS_OK)
        status = input_image_make_mask(&image, mask->file, mask->channel ? mask->channel : "A",
                                       &job->counted);
    image_finish(&image);
    return status;
}

/* ---- checks ---- */

static enum status check_options(struct job *job)
{
    const struct app_options *o = job->options;
    const char *const *paths = o->positionals;
    enum status status = STATUS_USAGE;
    if (!paths[1]) {
        log_error("expected two images: firn diff REFERENCE TEST (see --help)");
        return status;
    }
    job->is_display = path_ends_in(paths[0], ".png");
    if (job->is_display != path_ends_in(paths[1], ".png"))
        log_error("cannot compare %s with %s: a PNG image can only be compared with another PNG "
                  "image",
                  paths[0], paths[1]);
    else if (job->is_display && o->diff.has_exposure)
        log_error("--exposure: not available for PNG images, which are already exposed");
    else if (o->mask.channel && !o->mask.file)
        log_error("--mask-channel %s: --mask is missing", o->mask.channel);
    else
        status = STATUS_OK;
    for (uint32_t i = 0; i < o->run.outputs.count && status == STATUS_OK; i++)
        status = file_io_check(o->run.outputs.paths[i]);
    return status;
}

/* Checks that the images have the channels that the options need. */
static enum status check_layers(const struct job *job)
{
    const struct app_options *o = job->options;
    const struct comparison *c = &job->comparison;
    double value;
    if (!c->layer_count) {
        log_error("cannot compare %s with %s: the files have no channel in common",
                  o->positionals[0], o->positionals[1]);
        return STATUS_DATA;
    }
    for (int i = 0; i < COMPARISON_METRIC_COUNT; i++) {
        if (!o->diff.has_limit[i] || comparison_metric(c, (enum comparison_metric)i, &value))
            continue;
        log_error("--fail-above %s: expected the channels %s in both images",
                  comparison_metric_names[i],
                  i == COMPARISON_ANGLE ? "exit.X, exit.Y and exit.Z" : "R, G and B");
        return STATUS_DATA;
    }
    for (uint32_t i = 0; i < o->run.outputs.count; i++) {
        if (c->has_beauty || (c->has_exit && path_ends_in(o->run.outputs.paths[i], ".exr")))
            continue;
        log_error("cannot write %s: expected the channels R, G and B in both images",
                  o->run.outputs.paths[i]);
        return STATUS_DATA;
    }
    return STATUS_OK;
}

/* Compares the metrics with the limits of --fail-above. Non-finite values exceed any limit. */
static void check_limits(struct job *job)
{
    const struct app_diff *o = &job->options->diff;
    for (int i = 0; i < COMPARISON_METRIC_COUNT; i++) {
        const char *name = comparison_metric_names[i];
        double value;
        const struct comparison_layer *layer =
            comparison_metric(&job->comparison, (enum comparison_metric)i, &value);
        if (!o->has_limit[i] || !layer)
            continue;
        const unsigned long long not_finite = layer->difference.not_finite;
        job->report.failed[i] = not_finite || !(value <= o->limits[i]);
        if (not_finite)
            log_error("%s: %llu values of layer %s are not finite", name, not_finite, layer->name);
        else if (job->report.failed[i])
            log_error("%s is %g, above the limit %g", name, value, o->limits[i]);
    }
}

/* ---- the error image ---- */

/* Encodes the FLIP heat map as a PNG file. Pixels outside the mask are black. */
static enum status encode_png(const struct job *job, void **data, size_t *size)
{
    const uint32_t width = job->reference.width, height = job->reference.height;
    uint8_t *rgba = calloc((size_t)width * height, 4);
    if (!rgba)
        return log_out_of_memory(NULL);
    for (size_t i = 0; i < (size_t)width * height; i++) {
        if (!job->counted || job->counted[i])
            heat_map_srgb(job->comparison.errors[i], &rgba[4 * i]);
    }
    const struct png_image_source heat = { .rgba = rgba, .width = width, .height = height };
    const enum status status = png_encode(&heat, data, size);
    free(rgba);
    return status;
}

/* Encodes the per-pixel errors of the comparison as an EXR file. */
static enum status encode_exr(const struct job *job, void **data, size_t *size)
{
    const struct comparison *c = &job->comparison;
    struct image_plane planes[2];
    struct image image = {
        .width = job->reference.width,
        .height = job->reference.height,
        .planes = planes,
    };
    if (c->errors)
        planes[image.plane_count++] = (struct image_plane){ .name = "flip.Z", .texels = c->errors };
    if (c->degrees)
        planes[image.plane_count++] =
            (struct image_plane){ .name = "angle.Z", .texels = c->degrees };
    return exr_encode(&image, &(struct exr_header){ 0 }, data, size);
}

static enum status write_errors(const struct job *job, const char *path)
{
    void *data = NULL;
    size_t size = 0;
    enum status status =
        path_ends_in(path, ".png") ? encode_png(job, &data, &size) : encode_exr(job, &data, &size);
    if (status == STATUS_OK)
        status = file_io_write(path, data, size);
    free(data);
    return status;
}

/* ---- the command ---- */

static enum status compare(struct job *job)
{
    const struct app_diff *o = &job->options->diff;
    const struct comparison_params params = {
        .reference = &job->reference,
        .test = &job->test,
        .counted = job->counted,
        .display = job->is_display,
        .has_exposure = o->has_exposure,
        .exposure = (double)o->exposure,
        .curve = o->curve,
        .ppd = o->ppd > 0.0f ? (double)o->ppd : FLIP_PPD,
    };
    if (!comparison_init(&job->comparison, &params))
        return log_out_of_memory(NULL);
    job->report = (struct diff_report){
        .options = job->options,
        .comparison = &job->comparison,
        .width = job->reference.width,
        .height = job->reference.height,
        .ppd = params.ppd,
    };
    return check_layers(job);
}

static enum status print_report(const struct job *job)
{
    if (job->options->run.format != APP_FORMAT_JSON)
        diff_report_text(&job->report, stdout);
    else if (!diff_report_json(&job->report, stdout))
        return log_out_of_memory(NULL);
    return STATUS_OK;
}

static enum status run(struct job *job)
{
    const struct app_options *o = job->options;
    enum status status = check_options(job);
    if (status == STATUS_OK)
        status = read_images(job);
    if (status == STATUS_OK && o->mask.file)
        status = read_mask(job);
    if (status == STATUS_OK)
        status = compare(job);
    for (uint32_t i = 0; i < o->run.outputs.count && status == STATUS_OK; i++)
        status = write_errors(job, o->run.outputs.paths[i]);
    if (status != STATUS_OK)
        return status;
    check_limits(job);
    status = print_report(job);
    for (int i = 0; i < COMPARISON_METRIC_COUNT && status == STATUS_OK; i++)
        status = job->report.failed[i] ? STATUS_FAILED : STATUS_OK;
    return status;
}

enum status app_diff(const struct app_options *options)
{
    struct job job = { .options = options };
    enum status status = run(&job);
    comparison_finish(&job.comparison);
    free(job.counted);
    image_finish(&job.reference);
    image_finish(&job.test);
    return status;
}
