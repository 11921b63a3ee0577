/* render.c: firn render: a picture or a sequence of them, to EXR and PNG. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/frame_name.h"
#include "src/app/frame_range.h"
#include "src/app/output.h"
#include "src/app/progress.h"
#include "src/app/show.h"
#include "src/app/stop.h"
#include "src/image/file.h"
#include "src/log.h"
#include "src/reference/reference.h"
#include "src/renderer.h"
#include "src/scene_settings.h"

struct job {
    struct app_options o;
    struct frame_range range; /* without --frames: frame 0 */
    struct frame_name names[APP_OUTPUT_COUNT];
    struct stop stop;
    struct scene scene;
    struct camera camera;
    struct gpu gpu;
    struct renderer *renderer;   /* it or ... */
    struct reference *reference; /* ... it draws; NULL until a frame needs it */
    struct progress progress;
};

/* One frame of the job. */
struct frame {
    struct output output;
    char *paths[APP_OUTPUT_COUNT];
    bool is_current[APP_OUTPUT_COUNT]; /* has the frame already */
    struct render_result result;
};

static enum status out_of_memory(void)
{
    log_error("out of memory");
    return STATUS_TRY_AGAIN;
}

/* ---- what is wrong with the words ---- */

static enum status parse_frames(struct job *job)
{
    if (job->o.frames)
        return frame_range_parse(&job->range, job->o.frames);
    job->range.frames = calloc(1, sizeof(*job->range.frames));
    job->range.count = 1;
    return job->range.frames ? STATUS_OK : out_of_memory();
}

/* After the names: those of all frames must differ, whoever draws them. */
static enum status take_chunk(struct job *job)
{
    const struct app_options *o = &job->o;
    if (!o->frames) {
        log_error("--chunk %u/%u: it needs --frames", o->chunk, o->chunk_count);
        return STATUS_USAGE;
    }
    frame_range_chunk(&job->range, o->chunk, o->chunk_count);
    if (!job->range.count && !o->quiet)
        fprintf(stderr, "--chunk %u/%u: has no frame\n", o->chunk, o->chunk_count);
    return STATUS_OK;
}

static enum status parse_name(struct job *job, uint32_t i)
{
    const char *path = job->o.outputs[i];
    struct frame_name *name = &job->names[i];

    *name = (struct frame_name){ .path = path };
    if (!job->o.frames) {
        if (!frame_name_is_pattern(path))
            return STATUS_OK;
        log_error("--output %s: a place for the frame's number needs --frames", path);
        return STATUS_USAGE;
    }
    enum status status = frame_name_parse(name, path);
    if (status != STATUS_OK || job->range.count == 1 || name->length)
        return status;
    if (!strcmp(path, "-"))
        log_error("--output -: stdout takes one picture, --frames names %u", job->range.count);
    else
        log_error("--output %s: %u frames need a place for their number, such as #### or %%04d",
                  path, job->range.count);
    return STATUS_USAGE;
}

static enum status parse_names(struct job *job)
{
    struct app_options *o = &job->o;
    enum status status = STATUS_OK;
    bool stdout_taken = false;
    bool has_png = false;
    if (!o->output_count)
        o->outputs[o->output_count++] = o->frames ? "firn.####.exr" : "firn.exr";
    for (uint32_t i = 0; i < o->output_count && status == STATUS_OK; i++) {
        bool is_stdout = !strcmp(o->outputs[i], "-");
        if (is_stdout && stdout_taken) {
            log_error("-o - twice: stdout takes one picture");
            return STATUS_USAGE;
        }
        stdout_taken = stdout_taken || is_stdout;
        has_png = has_png || output_is_png(o->outputs[i]);
        status = parse_name(job, i);
    }
    if (status == STATUS_OK && o->show && !has_png) {
        log_error("--show %s: only PNG files show a layer; name one (-o FILE.png)", o->show->name);
        return STATUS_USAGE;
    }
    return status;
}

static double frame_time(const struct job *job, int32_t frame)
{
    const struct motion_params *motion = settings_of(&job->o.settings, &motion_settings);
    return (double)motion->time + frame / (double)motion->fps;
}

/* Every file can be created, and every time is one that --set motion.time takes. */
static enum status check_frame(const struct job *job, int32_t frame)
{
    const struct setting *row = settings_find("motion.time");
    double time = frame_time(job, frame);
    enum status status = STATUS_OK;
    if (time < row->min || time > row->max) {
        log_error("--frames %s: frame %d would be at %.7g seconds, not within %.7g and %.7g "
                  "(motion.time + frame / motion.fps)",
                  job->o.frames, (int)frame, time, row->min, row->max);
        return STATUS_USAGE;
    }
    for (uint32_t i = 0; i < job->o.output_count && status == STATUS_OK; i++) {
        char *path = frame_name_make(&job->names[i], frame);
        status = path ? file_check(path) : out_of_memory();
        free(path);
    }
    return status;
}

static enum status check(struct job *job)
{
    enum status status = parse_frames(job);
    if (status == STATUS_OK)
        status = parse_names(job);
    if (status == STATUS_OK && job->o.chunk)
        status = take_chunk(job);
    for (uint32_t i = 0; i < job->range.count && status == STATUS_OK; i++)
        status = check_frame(job, job->range.frames[i]);
    return status;
}

/* ---- a frame ---- */

static void frame_finish(struct frame *frame)
{
    for (uint32_t i = 0; i < APP_OUTPUT_COUNT; i++)
        free(frame->paths[i]);
    output_finish(&frame->output);
    render_result_finish(&frame->result);
}

/* Names and describes it, and sees which files have it already. */
static enum status frame_init(struct frame *frame, const struct job *job, int32_t number)
{
    *frame = (struct frame){
        .output = {
            .options = &job->o,
            .scene = &job->scene,
            .shot = { .camera = job->camera, .time = (float)frame_time(job, number) },
        },
    };
    enum status status = output_describe(&frame->output);
    for (uint32_t i = 0; i < job->o.output_count && status == STATUS_OK; i++) {
        frame->paths[i] = frame_name_make(&job->names[i], number);
        if (!frame->paths[i])
            status = out_of_memory();
        else if (job->o.resume)
            frame->is_current[i] = output_is_current(&frame->output, frame->paths[i]);
    }
    return status;
}

static bool frame_is_current(const struct frame *frame, uint32_t output_count)
{
    uint32_t current = 0;
    for (uint32_t i = 0; i < output_count; i++)
        current += frame->is_current[i];
    return current == output_count;
}

static bool show_progress(void *user, uint32_t done, uint32_t all)
{
    const struct job *job = user;
    progress_show(&job->progress, done, all);
    return true;
}

static enum status draw(struct job *job, struct frame *frame)
{
    const struct frame_layer *show = job->o.show;
    const struct renderer_shot *shot = &frame->output.shot;
    struct render_result *result = &frame->result;
    progress_show(&job->progress, 0, job->o.samples);
    enum status status = job->reference
                             ? reference_render(job->reference, shot, result, show_progress, job)
                             : renderer_render(job->renderer, shot, result, show_progress, job);
    progress_clear(&job->progress);
    if (status == STATUS_OK && show) {
        result->rgba = show_rgba(&result->image, show);
        status = result->rgba ? STATUS_OK : STATUS_TRY_AGAIN;
    }
    return status;
}

static enum status open_reference(struct job *job, const struct renderer_params *params)
{
    const struct reference_request request = {
        .scene = params->scene,
        .settings = params->settings,
        .width = params->width,
        .height = params->height,
        .samples = params->samples,
        .layers = params->layers,
        .linear = params->linear,
        .display = params->display,
    };
    char names[64];
    enum status status = reference_create(&job->reference, &request);
    if (status == STATUS_OK && !job->o.quiet &&
        reference_leaves_out(params->settings, names, sizeof(names)))
        log_warning("--refraction reference: it is the smooth object alone, without %s", names);
    return status;
}

/* Opens the device, or what traces, with the first frame that has to be drawn. */
static enum status open_renderer(struct job *job)
{
    const struct app_options *o = &job->o;
    struct renderer_params params = {
        .gpu = &job->gpu,
        .scene = &job->scene,
        .settings = &o->settings,
        .rung = o->rung,
        .width = o->width,
        .height = o->height,
        .samples = o->samples,
        .sharing = o->sharing,
    };
    for (uint32_t i = 0; i < o->output_count; i++) {
        if (output_is_png(o->outputs[i]))
            params.display = !o->show;
        else
            params.linear = true;
    }
    if (params.linear)
        params.layers = o->layers;
    else if (o->layers)
        log_warning("--aov: PNG files have no layers; name an .exr file too");
    params.layers |= show_bit(o->show);
    if (o->rung == &reference_rung)
        return open_reference(job, &params);
    enum status status = gpu_create(&job->gpu, &(struct gpu_params){
                                                   .device = o->device,
                                                   .validate = o->validate,
                                                   .no_cache = o->no_cache,
                                               });
    if (status == STATUS_OK)
        status = renderer_create(&job->renderer, &params);
    return status;
}

static enum status write_output(struct job *job, const struct frame *frame, const char *path)
{
    const struct app_options *o = &job->o;
    const bool is_straight = file_is_straight(path); /* a pipe may wait for ever */
    void *data = NULL;
    size_t size = 0;
    const char *device =
        job->reference ? reference_device(job->reference) : job->gpu.properties.deviceName;
    enum status status = output_encode(&frame->output, path, &frame->result, device, &data, &size);
    if (status == STATUS_OK) {
        if (!is_straight)
            stop_hold(&job->stop);
        status = file_write(path, data, size);
        if (!is_straight)
            stop_release(&job->stop);
    }
    free(data);
    if (status == STATUS_OK && !o->quiet)
        fprintf(stderr, "%s: %ux%u, %u sample%s\n", strcmp(path, "-") ? path : "stdout", o->width,
                o->height, o->samples, o->samples > 1 ? "s" : "");
    return status;
}

static enum status write_outputs(struct job *job, const struct frame *frame)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < job->o.output_count && status == STATUS_OK; i++) {
        if (!frame->is_current[i])
            status = write_output(job, frame, frame->paths[i]);
        else if (!job->o.quiet)
            fprintf(stderr, "%s: up to date\n", frame->paths[i]);
    }
    return status;
}

static enum status run_frame(struct job *job, int32_t number)
{
    struct frame frame;
    enum status status = frame_init(&frame, job, number);
    if (status == STATUS_OK && !frame_is_current(&frame, job->o.output_count)) {
        if (!job->renderer && !job->reference)
            status = open_renderer(job);
        if (status == STATUS_OK)
            status = draw(job, &frame);
    }
    if (status == STATUS_OK)
        status = write_outputs(job, &frame);
    frame_finish(&frame);
    return status;
}

/*
 * Everything that can be wrong with the words and files is found before the device is opened. The
 * first frame that fails is the last: what fails one (a full disk, a lost device) fails the next.
 */
static enum status run(struct job *job)
{
    enum status status = check(job);
    if (status == STATUS_OK)
        status = app_load_scene(&job->scene, &job->o);
    if (status == STATUS_OK)
        status = app_camera(&job->camera, &job->scene, &job->o);
    progress_begin(&job->progress, job->range.count,
                   job->o.rung == &reference_rung ? "tiles" : "samples", job->o.quiet);
    for (uint32_t i = 0; i < job->range.count && status == STATUS_OK; i++) {
        job->progress.frame = i;
        status = run_frame(job, job->range.frames[i]);
    }
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has said why */
    return status;
}

enum status app_render(const struct app_options *options)
{
    struct job *job = calloc(1, sizeof(*job));
    if (!job)
        return out_of_memory();
    job->o = *options;
    if (!job->o.samples)
        job->o.samples = 1;
    enum status status = stop_begin(&job->stop);
    if (status == STATUS_OK)
        status = run(job);
    stop_end(&job->stop);
    renderer_destroy(job->renderer);
    reference_destroy(job->reference);
    gpu_destroy(&job->gpu);
    scene_finish(&job->scene);
    frame_range_finish(&job->range);
    free(job);
    return status;
}
