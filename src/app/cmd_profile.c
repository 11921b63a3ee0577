/* cmd_profile.c: command firn profile: measures the cost of each pass of a frame on a device. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/options/sweep_values.h"
#include "src/app/profile_job.h"
#include "src/base/log.h"
#include "src/file/atomic_file.h"
#include "src/lab/profile/baseline_comparison.h"
#include "src/lab/profile/chrome_trace.h"
#include "src/lab/profile/csv.h"
#include "src/lab/profile/json.h"
#include "src/lab/profile/table.h"

/* ---- checks of the options ---- */

static enum status check_reports(const struct app_profile *options)
{
    const char *const paths[] = { options->json, options->csv, options->trace };
    uint32_t stdout_count = 0;
    enum status status = STATUS_OK;
    for (size_t i = 0; i < sizeof(paths) / sizeof(paths[0]) && status == STATUS_OK; i++) {
        if (!paths[i])
            continue;
        stdout_count += !strcmp(paths[i], "-");
        status = file_io_check(paths[i]);
    }
    if (status == STATUS_OK && stdout_count > 1) {
        log_error("stdout can hold only one report, but '-' is given for several");
        status = STATUS_USAGE;
    }
    return status;
}

/* ---- reports ---- */

static enum status write_csv(const char *path, const struct profile *profile)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (out) {
        profile_csv(profile, out);
        if (!fclose(out))
            return profile_job_write_text(path, STATUS_OK, text, size);
        free(text);
    }
    return log_out_of_memory(NULL);
}

static enum status write_reports(const struct profile_job *job, const struct profile *profile)
{
    const struct app_profile *to = &job->o.profile;
    enum status status = STATUS_OK;
    char *text;
    size_t size;
    if (to->json) {
        enum status made = profile_write_json(profile, &text, &size);
        status = profile_job_write_text(to->json, made, text, size);
    }
    if (to->csv && status == STATUS_OK)
        status = write_csv(to->csv, profile);
    if (to->trace && status == STATUS_OK) {
        enum status made = profile_write_trace(profile, &text, &size);
        status = profile_job_write_text(to->trace, made, text, size);
    }
    return status;
}

/* ---- one frame ---- */

static enum status run_frame(struct profile_job *job)
{
    struct profile profile = { 0 };
    bool is_slower = false;
    enum status status = profile_job_measure(job, &job->o.image, &profile, 1);
    if (status == STATUS_OK)
        status = write_reports(job, &profile);
    if (status == STATUS_OK && profile_job_has_table(&job->o.profile))
        status = profile_table(&profile, job->o.profile.each, stdout);
    if (status == STATUS_OK && job->o.profile.baseline) {
        FILE *out = profile_job_has_table(&job->o.profile) ? stdout : stderr;
        putc('\n', out);
        status = profile_compare(&job->baseline, &profile, job->o.profile.each, out, &is_slower);
    }
    if (status == STATUS_OK && job->capture[0] && !job->o.run.quiet)
        fprintf(stderr, "RenderDoc has captured a frame: %s\n", job->capture);
    profile_finish(&profile);
    return status == STATUS_OK && is_slower ? STATUS_FAILED : status;
}

/* ---- a sweep ---- */

/* Refuses reports that describe a single frame, because several frames will be measured. */
static enum status refuse_reports(const struct app_profile *options, const char *many)
{
    if (!options->baseline && !options->csv && !options->trace && !options->capture)
        return STATUS_OK;
    log_error("--csv, --trace, --baseline and --capture: not available with %s; use --json", many);
    return STATUS_USAGE;
}

static enum status run_sweep(struct profile_job *job)
{
    struct setup_image image;
    enum status status = STATUS_OK;
    job->progress.frame_name = "point";
    for (uint32_t i = 0; i < job->sweep.point_count && status == STATUS_OK; i++) {
        job->progress.frame = i;
        status = sweep_values_apply(&job->sweep, i, &job->o.image, &image);
        if (status == STATUS_OK)
            status = profile_job_measure(job, &image, &job->sweep.points[i], 1);
    }
    if (status == STATUS_OK && profile_job_has_table(&job->o.profile))
        status = profile_sweep_table(&job->sweep, stdout);
    return status == STATUS_OK ? profile_job_write_sweep(job) : status;
}

/* ---- the command ---- */

/* Finds all errors in arguments and files before the device is opened. */
static enum status check(struct profile_job *job, bool is_paper)
{
    const struct app_options *o = &job->o;
    enum status status = check_reports(&o->profile);
    if (status == STATUS_OK && is_paper && o->sweeps.count) {
        log_error("--sweep: not available with firn profile paper");
        status = STATUS_USAGE;
    }
    if (status == STATUS_OK && (is_paper || o->sweeps.count))
        status = refuse_reports(&o->profile, is_paper ? "firn profile paper" : "--sweep");
    if (status == STATUS_OK)
        status = sweep_values_parse(&job->sweep, &o->sweeps, &o->image);
    if (status == STATUS_OK && o->profile.baseline)
        status = profile_read_json(o->profile.baseline, &job->baseline);
    return status;
}

static enum status run(struct profile_job *job)
{
    const struct app_options *o = &job->o;
    const bool is_paper = o->image.scene.name && !strcmp(o->image.scene.name, "paper");
    enum status status = check(job, is_paper);
    const uint32_t points = job->sweep.point_count;
    progress_begin(&job->progress, points ? points : 1, "runs", o->run.quiet);
    if (status != STATUS_OK)
        return status;
    if (is_paper)
        return profile_paper(job);
    return points ? run_sweep(job) : run_frame(job);
}

enum status app_profile(const struct app_options *options)
{
    struct profile_job *job = calloc(1, sizeof(*job));
    if (!job) {
        return log_out_of_memory(NULL);
    }
    job->o = *options;
    enum status status = run(job);
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has logged why */
    profile_sweep_finish(&job->sweep);
    profile_finish(&job->baseline);
    gpu_destroy(&job->gpu);
    free(job);
    return status;
}
