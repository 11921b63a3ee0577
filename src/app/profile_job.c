/* profile_job.c: opens the device of a profile, and measures the images that options describe. */
#include "src/app/profile_job.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/shell_quote.h"
#include "src/file/atomic_file.h"
#include "src/gpu/gpu_renderdoc_capture.h"
#include "src/lab/profile/json.h"
#include "src/render/frame/pass_list.h"
#include "src/render/lavapipe_tuning.h"
#include "src/render/make_frame_request.h"
#include "src/scene/material.h"
#include "src/settings/scene_settings.h"

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

/* ---- a profile ---- */

static bool show_progress(void *user, uint32_t done, uint32_t all)
{
    struct profile_job *job = user;
    progress_show(&job->progress, done, all);
    return true;
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
        FILE *out = fmemopen(setting->value, sizeof(setting->value), "w");
        if (!out)
            return false;
        snprintf(setting->name, sizeof(setting->name), "%s", row->name);
        settings_print(settings, row, out);
        fclose(out);
    }
    return true;
}

/* Writes the name of a material with the scene's refractive index, else the index itself. */
static void describe_material(struct profile *p, const struct setup_scene *options)
{
    const double ior = settings_get(&options->settings, settings_find("refract.ior"));
    const struct material_preset *named =
        options->material ? material_preset_find(options->material) : &material_presets[0];
    for (; named->name && fabs((double)named->ior - ior) > 1e-6; named++)
        continue;
    if (named->name)
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
    describe_material(p, options);
    if (p->scene && p->command && describe_settings(p, &settings))
        return STATUS_OK;
    profile_finish(p);
    return log_out_of_memory(NULL);
}

/* An image to be measured, and its scene. */
struct subject {
    struct setup_image image;
    struct scene scene;
};

/* Loads the subject's scene and fills the request, which points to the subject. */
static enum status prepare(struct profile_job *job, struct subject *subject,
                           struct profile_request *request)
{
    const struct app_profile *o = &job->o.profile;
    struct setup_image *p = &subject->image;
    *request = (struct profile_request){
        .warmup = o->warmup,
        .run_count = o->run_count,
        .capture = o->capture ? job->capture : NULL,
        .time_step = o->time_step,
    };
    enum status status = setup_load_scene(&subject->scene, &p->scene);
    if (status == STATUS_OK)
        status = setup_camera(&request->camera, &subject->scene, p);
    if (status == STATUS_OK)
        setup_choose_refraction(p, &subject->scene, &request->camera);
    const bool is_first = !job->gpu.device;
    if (status == STATUS_OK && is_first)
        status = open_device(job);
    if (status == STATUS_OK && is_first)
        setup_check_rays(&p->scene.settings, &job->gpu);
    if (status == STATUS_OK) {
        const struct motion_params *motion = settings_of(&p->scene.settings, &motion_settings);
        request->clock = job->clock;
        request->time = (double)motion->time;
        request->renderer = setup_renderer_params(p, &job->gpu, &subject->scene);
        renderer_set_camera(&request->renderer, &request->camera);
    }
    return status;
}

enum status profile_job_measure(struct profile_job *job, const struct setup_image *images,
                                struct profile *profiles, uint32_t count)
{
    struct subject *subjects = calloc(count, sizeof(*subjects));
    struct profile_request *requests = calloc(count, sizeof(*requests));
    const struct profile_run run = { requests, profiles, count, show_progress, job };
    enum status status = subjects && requests ? STATUS_OK : log_out_of_memory(NULL);
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++) {
        subjects[i].image = images[i];
        status = prepare(job, &subjects[i], &requests[i]);
    }
    if (status == STATUS_OK) {
        status = profile_measure(&run);
        progress_clear(&job->progress);
    }
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++)
        status = describe(&profiles[i], &subjects[i].image, &subjects[i].scene, job->o.run.args);
    for (uint32_t i = 0; i < count && subjects; i++)
        scene_finish(&subjects[i].scene);
    free(requests);
    free(subjects);
    return status;
}

/* ---- reports ---- */

static bool is_stdout(const char *path)
{
    return path && !strcmp(path, "-");
}

bool profile_job_has_table(const struct app_profile *options)
{
    return !is_stdout(options->json) && !is_stdout(options->csv) && !is_stdout(options->trace);
}

enum status profile_job_write_text(const char *path, enum status made, char *text, size_t size)
{
    enum status status = made == STATUS_OK ? file_io_write(path, text, size) : made;
    free(text);
    return status;
}

enum status profile_job_write_sweep(const struct profile_job *job)
{
    const struct app_profile *to = &job->o.profile;
    char *text;
    size_t size;
    if (!to->json)
        return STATUS_OK;
    enum status made = profile_write_sweep_json(&job->sweep, &text, &size);
    return profile_job_write_text(to->json, made, text, size);
}
