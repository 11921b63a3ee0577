/* cmd_profile.c: command firn profile: measures the cost of each pass of a frame on a device. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/options/sweep_values.h"
#include "src/app/profile_startup.h"
#include "src/app/progress.h"
#include "src/base/log.h"
#include "src/base/shell_quote.h"
#include "src/base/text_stream.h"
#include "src/file/atomic_file.h"
#include "src/gpu/gpu_renderdoc_capture.h"
#include "src/lab/profile/measure_frames.h"
#include "src/lab/profile/profile_reports.h"
#include "src/render/frame/pass_list.h"
#include "src/render/lavapipe_tuning.h"
#include "src/render/make_frame_request.h"
#include "src/settings/scene_settings.h"
#include "src/setup/setup_material.h"

enum {
    REPORT_COUNT = 3
};

struct profile_job {
    struct app_options o;
    struct gpu gpu;      /* opened by the first frame */
    enum rg_clock clock; /* RG_CLOCK_EXACT or RG_CLOCK_SUBMITS */
    struct progress progress;
    struct profile baseline;
    struct profile_sweep sweep; /* one point and no parameters without --sweep */
    char capture[MEASURE_PATH_SIZE];
};

/* ---- device and clock ---- */

/* Returns the requested clock if the device has it. By default, GPU timestamps time the passes. On
 * CPU devices, the default is the host's clock, because it measures the same cores. */
static enum rg_clock choose_clock(const struct gpu *gpu, enum rg_clock requested)
{
    const bool has_timestamps = gpu->properties.limits.timestampComputeAndGraphics;
    if (requested == RG_CLOCK_NONE)
        requested = lavapipe_tuning_is_cpu(gpu) ? RG_CLOCK_SUBMITS : RG_CLOCK_EXACT;
    else if (requested == RG_CLOCK_EXACT && !has_timestamps)
        log_warning("--clock: the device has no timestamps, so each pass is submitted alone");
    return has_timestamps ? requested : RG_CLOCK_SUBMITS;
}

static enum status open_device(struct profile_job *job)
{
    const struct app_profile *o = &job->o.profile;
    enum status status = gpu_create(&job->gpu, &job->o.run.gpu);
    const char *trouble = status == STATUS_OK && o->capture ? gpu_capture_problem() : NULL;
    if (trouble) {
        log_error("--capture: %s", trouble);
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        job->clock = choose_clock(&job->gpu, o->clock);
    return status;
}

/* ---- measuring ---- */

static void show_progress(void *user, uint32_t done, uint32_t all)
{
    struct profile_job *job = user;
    progress_show(&job->progress, done, all);
}

static bool describe_settings(struct profile *p, const struct settings *settings)
{
    size_t count = 0;
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row))
        count++;
    p->settings = calloc(count + 1, sizeof(*p->settings));
    if (!p->settings)
        return false;
    for (const struct setting *row = settings_next(NULL); row; row = settings_next(row)) {
        struct profile_setting *setting = &p->settings[p->setting_count++];
        struct text_stream stream;
        FILE *out = text_stream_open(&stream);
        if (out)
            settings_print(settings, row, out);
        char *value = text_stream_close(&stream, NULL);
        if (!value)
            return false;
        snprintf(setting->name, sizeof(setting->name), "%s", row->name);
        snprintf(setting->value, sizeof(setting->value), "%s", value);
        free(value);
    }
    return true;
}

/* Writes the name of a material with the scene's refractive index, else the index itself. */
static void describe_material(struct profile *p, const struct setup_scene *options,
                              const struct scene *scene)
{
    const double ior = settings_get(&options->settings, settings_find("refract.ior"));
    const struct material_preset *named =
        setup_find_material(&options->settings, setup_absorption_scale(options->name, scene));
    struct material_choice choice;
    if (options->material && named &&
        material_choice_parse(&choice, options->material, strlen(options->material)) &&
        choice.preset->ior == named->ior)
        snprintf(p->material, sizeof(p->material), "%s", options->material);
    else if (named)
        snprintf(p->material, sizeof(p->material), "%s", named->name);
    else
        snprintf(p->material, sizeof(p->material), "refractive index %g", ior);
}

static enum status describe(struct profile *p, const struct setup_image *image,
                            const struct scene *scene, char *const *args)
{
    const struct setup_scene *options = &image->scene;
    const struct settings settings =
        frame_resolve_settings(&options->settings, scene, image->refraction, image->height);
    p->scene = strdup(options->name);
    p->command = shell_quote_join(args);
    describe_material(p, options, scene);
    if (p->scene && p->command && describe_settings(p, &settings))
        return STATUS_OK;
    profile_finish(p);
    return log_out_of_memory(NULL);
}

/* Loads the scene of an image, and fills the request, which points to both. */
static enum status prepare(struct profile_job *job, struct setup_image *image, struct scene *scene,
                           struct profile_request *request)
{
    const struct app_profile *o = &job->o.profile;
    *request = (struct profile_request){
        .warmup = o->warmup,
        .run_count = o->run_count,
        .capture = o->capture ? job->capture : NULL,
        .time_step = o->time_step,
    };
    enum status status = setup_load_scene(scene, &image->scene);
    if (status == STATUS_OK)
        status = setup_camera(&request->camera, scene, image);
    if (status == STATUS_OK)
        setup_choose_refraction(image, scene, &request->camera);
    const bool is_first = !job->gpu.device;
    if (status == STATUS_OK && is_first)
        status = open_device(job);
    if (status == STATUS_OK && is_first)
        setup_check_rays(&image->scene.settings, &job->gpu);
    if (status == STATUS_OK) {
        const struct motion_params *motion = settings_of(&image->scene.settings, &motion_settings);
        request->clock = job->clock;
        request->time = (double)motion->time;
        request->renderer = setup_renderer_params(image, &job->gpu, scene);
        renderer_set_camera(&request->renderer, &request->camera);
    }
    return status;
}

static enum status measure_point(struct profile_job *job, uint32_t point)
{
    struct setup_image image;
    struct scene scene = { 0 };
    struct profile_request request;
    struct profile *profile = &job->sweep.points[point];
    enum status status = sweep_values_apply(&job->sweep, point, &job->o.image, &image);
    job->progress.frame = point;
    if (status == STATUS_OK)
        status = prepare(job, &image, &scene, &request);
    if (status == STATUS_OK) {
        status = profile_measure(&request, profile, show_progress, job);
        progress_clear(&job->progress);
    }
    if (status == STATUS_OK)
        status = describe(profile, &image, &scene, job->o.run.args);
    scene_finish(&scene);
    return status;
}

/* ---- reports ---- */

struct report {
    const char *path; /* NULL: not wanted */
    profile_report_fn *write;
};

static enum status check_reports(const struct report reports[static REPORT_COUNT])
{
    uint32_t stdout_count = 0;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < REPORT_COUNT && status == STATUS_OK; i++) {
        if (!reports[i].path)
            continue;
        stdout_count += !strcmp(reports[i].path, "-");
        status = file_io_check(reports[i].path);
    }
    if (status == STATUS_OK && stdout_count > 1) {
        log_error("stdout can hold only one report, but '-' is given for several");
        status = STATUS_USAGE;
    }
    return status;
}

static enum status write_report(const struct report *report, const struct profile_sweep *sweep)
{
    struct text_stream stream;
    size_t size = 0;
    FILE *out = text_stream_open(&stream);
    enum status status = out ? report->write(sweep, out) : STATUS_OK;
    char *text = text_stream_close(&stream, &size);
    if (!text && status == STATUS_OK)
        status = log_out_of_memory(NULL);
    if (status == STATUS_OK)
        status = file_io_write(report->path, text, size);
    free(text);
    return status;
}

static enum status report(const struct profile_job *job,
                          const struct report reports[static REPORT_COUNT], bool *is_slower)
{
    enum status status = STATUS_OK;
    bool has_table = true; /* stdout is free for tables */
    for (size_t i = 0; i < REPORT_COUNT && status == STATUS_OK; i++) {
        if (!reports[i].path)
            continue;
        has_table = has_table && strcmp(reports[i].path, "-") != 0;
        status = write_report(&reports[i], &job->sweep);
    }
    if (status == STATUS_OK && has_table)
        status = profile_table(&job->sweep, stdout);
    if (status == STATUS_OK && job->o.profile.baseline) {
        FILE *out = has_table ? stdout : stderr;
        putc('\n', out);
        status = profile_compare(&job->baseline, job->sweep.points, job->o.profile.threshold / 100,
                                 out, is_slower);
    }
    if (status == STATUS_OK && job->capture[0] && !job->o.run.quiet)
        fprintf(stderr, "RenderDoc has captured a frame: %s\n", job->capture);
    return status;
}

/* ---- the command ---- */

/* Finds all errors in arguments and files before the device is opened. */
static enum status check(struct profile_job *job, const struct report reports[static REPORT_COUNT])
{
    const struct app_options *o = &job->o;
    enum status status = check_reports(reports);
    if (status == STATUS_OK && o->sweeps.count &&
        (o->profile.baseline || o->profile.trace || o->profile.capture || o->profile.sort)) {
        log_error("--trace, --baseline, --capture and --sort: not available with --sweep");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK && !o->profile.baseline &&
        o->profile.threshold != APP_PROFILE_THRESHOLD) {
        log_error("--threshold: only available with --baseline");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK)
        status = sweep_values_parse(&job->sweep, &o->sweeps, &o->image);
    if (status == STATUS_OK && o->profile.baseline)
        status = profile_read_json(o->profile.baseline, &job->baseline);
    return status;
}

static enum status run(struct profile_job *job)
{
    const struct app_profile *o = &job->o.profile;
    const struct report reports[REPORT_COUNT] = {
        { o->json, profile_json },
        { o->csv, profile_csv },
        { o->trace, profile_trace },
    };
    bool is_slower = false;
    enum status status = check(job, reports);
    if (status != STATUS_OK)
        return status;
    if (job->sweep.parameter_count == 0)
        job->sweep.point_count = 1;
    progress_begin(&job->progress, job->sweep.point_count, "runs", job->o.run.quiet);
    job->progress.frame_name = "point";
    job->sweep.slowest_first = o->sort;
    job->sweep.points = calloc(job->sweep.point_count, sizeof(*job->sweep.points));
    if (!job->sweep.points)
        return log_out_of_memory(NULL);
    for (uint32_t i = 0; i < job->sweep.point_count && status == STATUS_OK; i++)
        status = measure_point(job, i);
    if (status == STATUS_OK)
        status = report(job, reports, &is_slower);
    return status == STATUS_OK && is_slower ? STATUS_FAILED : status;
}

/* Refuses options that only concern runs beside --startup. */
static enum status check_startup(const struct app_options *o)
{
    const struct app_profile *p = &o->profile;
    if (!p->startup ||
        !(o->sweeps.count || p->csv || p->trace || p->baseline || p->capture || p->sort))
        return STATUS_OK;
    log_error("--startup: not available with --sweep, --csv, --trace, --baseline, --capture or "
              "--sort");
    return STATUS_USAGE;
}

enum status app_profile(const struct app_options *options)
{
    struct profile_job *job = calloc(1, sizeof(*job));
    if (!job) {
        return log_out_of_memory(NULL);
    }
    job->o = *options;
    enum status status = check_startup(options);
    if (status == STATUS_OK)
        status = options->profile.startup ? profile_startup(&job->o) : run(job);
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has logged why */
    profile_sweep_finish(&job->sweep);
    profile_finish(&job->baseline);
    gpu_destroy(&job->gpu);
    free(job);
    return status;
}
