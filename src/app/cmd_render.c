/* cmd_render.c: command firn render: renders an image or a sequence to EXR and PNG files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/app/app.h"
#include "src/app/options/command_options.h"
#include "src/app/progress.h"
#include "src/app/render_report.h"
#include "src/app/sample_sums_file.h"
#include "src/app/sequence_frame_list.h"
#include "src/base/clock.h"
#include "src/base/file_info.h"
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/base/signals.h"
#include "src/base/tile.h"
#include "src/file/atomic_file.h"
#include "src/file/image_receive.h"
#include "src/file/ocio_view.h"
#include "src/lib/image_session.h"
#include "src/render/lavapipe_tuning.h"
#include "src/scene/world_position.h"
#include "src/setup/aov_to_png.h"
#include "src/setup/image_output.h"
#include "src/tech/refract/cpu_reference_settings.h"

struct job {
    struct app_options o;
    struct sequence sequence;
    struct report report;
    struct signals stop;
    struct session_scene scene;
    struct gpu gpu;
    struct image_session session;
    struct render_result result;    /* rendered image of the current frame */
    struct ocio_view view;          /* of --ocio */
    bool has_outputs;               /* choose_outputs() was called */
    bool makes_png;                 /* make_png() is needed */
    uint32_t tile_done, tile_count; /* tiles of the current frame */
    uint64_t pixels_beyond;         /* total of all frames: reference.h */
    double remaining;
    struct progress progress;
};

/* Description and output files of a frame. */
struct frame {
    struct output output;
    char *paths[SETUP_OUTPUT_COUNT];
    bool is_current[SETUP_OUTPUT_COUNT]; /* the file already contains the frame */
    struct reference_outcome outcome;    /* result of the reference */
};

/* ---- a frame ---- */

static void frame_finish(struct frame *frame)
{
    for (uint32_t i = 0; i < SETUP_OUTPUT_COUNT; i++)
        free(frame->paths[i]);
    output_finish(&frame->output);
}

/* Returns true if a file contains the frame, drawn with `samples` samples. */
static bool has_samples(const struct output *output, const char *path,
                        const struct image_header *head, uint32_t samples)
{
    struct output drawn = *output;
    drawn.samples = samples;
    drawn.settings = drawn.png_settings = NULL;
    const bool same = output_describe(&drawn) == STATUS_OK && output_is_current(&drawn, path, head);
    output_finish(&drawn);
    return same;
}

/* Returns true if --resume may keep a file. If the file is invalid, logs why and returns false. */
static bool is_current(const struct job *job, const struct output *output, const char *path)
{
    struct image_header head;
    if (file_io_is_direct(path) || !file_is_readable(path) ||
        image_reader_check(&head, path, &job->o.image.scene.reader) != STATUS_OK)
        return false;
    const uint32_t samples =
        output_enough_samples(&head, job->o.image.samples, job->o.render.noise);
    const bool same = output_is_current(output, path, &head) ||
                      (samples && has_samples(output, path, &head, samples));
    image_header_finish(&head);
    return same;
}

/* Describes a frame, names its files and finds those that --resume keeps. */
static enum status frame_init(struct frame *frame, const struct job *job, int32_t number)
{
    *frame = (struct frame){
        .output = {
            .image = &job->o.image,
            .scene = &job->scene.scene,
            .is_frame = job->o.render.frames != NULL,
            .shot = {
                .camera = job->session.camera,
                .time = (float)sequence_time(&job->o.image.scene.settings, number),
                .tile = job->o.image.tile ? job->o.image.tile - 1 : 0,
            },
        },
    };
    enum status status = output_describe(&frame->output);
    for (uint32_t i = 0; i < job->o.run.outputs.count && status == STATUS_OK; i++) {
        frame->paths[i] = frame_name_make(&job->sequence.names[i], number);
        if (!frame->paths[i])
            status = log_out_of_memory(NULL);
        else if (job->o.render.resume)
            frame->is_current[i] = is_current(job, &frame->output, frame->paths[i]);
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
    const uint32_t tiles = job->tile_count ? job->tile_count : 1;
    progress_show(&job->progress, job->tile_done * all + done, tiles * all);
    return true;
}

static bool add_planes_of(const struct image *tile, struct image *image)
{
    for (uint32_t p = 0; p < tile->plane_count; p++) {
        if (!image_add_plane(image, tile->planes[p].name, tile->planes[p].half))
            return false;
        image->planes[p].integer = tile->planes[p].integer;
    }
    return true;
}

/* Allocates the whole image, with the same planes as a tile. */
static bool assemble_image(const struct job *job, const struct render_result *tile,
                           struct render_result *image)
{
    render_result_clear(image, job->o.image.width, job->o.image.height);
    if (!add_planes_of(&tile->image, &image->image) ||
        !add_planes_of(&tile->display, &image->display))
        return false;
    if (tile->rgba)
        image->rgba = malloc((size_t)job->o.image.width * job->o.image.height * 4);
    return !tile->rgba || image->rgba;
}

static void copy_tile(const struct job *job, uint32_t index, const struct render_result *tile,
                      struct render_result *image)
{
    const bool is_interleaved = job->o.image.interleaved;
    const struct tiling tiling = { job->o.image.width, job->o.image.height, job->o.image.columns,
                                   job->o.image.rows };
    const struct tile at =
        is_interleaved ? (struct tile){ index % tiling.columns, index / tiling.columns, 0, 0 }
                       : tile_at(&tiling, index);
    const size_t across = is_interleaved ? tiling.columns : 1,
                 down = is_interleaved ? tiling.rows : 1;
    for (size_t y = 0; y < tile->image.height; y++) {
        for (size_t x = 0; x < tile->image.width; x++) {
            const size_t from = y * tile->image.width + x;
            const size_t to = (down * y + at.y) * tiling.width + across * x + at.x;
            for (uint32_t p = 0; p < image->image.plane_count; p++)
                image->image.planes[p].texels[to] = tile->image.planes[p].texels[from];
            for (uint32_t p = 0; p < image->display.plane_count; p++)
                image->display.planes[p].texels[to] = tile->display.planes[p].texels[from];
            if (image->rgba)
                memcpy(&image->rgba[4 * to], &tile->rgba[4 * from], 4);
        }
    }
}

static enum status draw_tiles(struct job *job, const struct renderer_shot *shot,
                              struct render_result *image)
{
    struct render_result tile = { 0 };
    enum status status = STATUS_OK;
    job->tile_count = job->o.image.columns * job->o.image.rows;
    for (uint32_t i = 0; i < job->tile_count && status == STATUS_OK; i++) {
        struct renderer_shot tile_shot = *shot;
        tile_shot.tile = i;
        job->tile_done = i;
        status = image_session_draw(&job->session, &tile_shot, &tile, show_progress, job);
        if (status == STATUS_OK && i == 0 && !assemble_image(job, &tile, image))
            status = log_out_of_memory(NULL);
        if (status == STATUS_OK)
            copy_tile(job, i, &tile, image);
    }
    render_result_finish(&tile);
    return status == STATUS_OK ? renderer_finish_display(job->session.renderer, image) : status;
}

/* Returns the EXR file that the frame's sample sums belong to, or NULL if no sums are stored. */
static const char *sums_image(const struct job *job, const struct frame *frame)
{
    for (uint32_t i = 0; i < job->o.run.outputs.count && job->o.render.keep_sums; i++) {
        if (path_ends_in(frame->paths[i], ".exr"))
            return frame->paths[i];
    }
    return NULL;
}

/* Renders with the path tracer, from stored sample sums if any. Records the sample count. */
static enum status trace_image(struct job *job, struct frame *frame)
{
    const char *image = sums_image(job, frame);
    char *path = image ? option_sums_file(image) : NULL;
    struct output *output = &frame->output;
    struct sample_sums_file file = {
        .path = path,
        .output = output,
        .device = image_session_device(&job->session),
        .stop = &job->stop,
    };
    struct reference_session session = {
        .load = path && job->o.render.resume ? sample_sums_file_load : NULL,
        .save = path ? sample_sums_file_store : NULL,
        .user = &file,
    };
    if (image && !path)
        return log_out_of_memory(NULL);
    render_result_finish(&job->result);
    enum status status = reference_continue(job->session.reference, &output->shot, &job->result,
                                            &session, show_progress, job);
    free(path);
    output->samples = session.outcome.samples;
    output->noise = session.outcome.noise;
    frame->outcome = session.outcome;
    if (status == STATUS_OK)
        status = image_session_trace_layers(&job->session, &output->shot, &job->result);
    return status == STATUS_OK ? output_describe(output) : status;
}

/* Warns, once for all frames, that light is missing because paths were cut off. */
static void warn_of_remaining(const struct job *job)
{
    const unsigned long long count = job->pixels_beyond;
    if (count && !job->o.run.quiet)
        log_warning(
            "--refraction reference: light paths were terminated early: up to %.2g of a pixel's "
            "light is missing, and more than %g in %llu pixel%s (see layer remaining); raise "
            "reference.bounces, lower reference.cutoff, or set reference.russian_roulette=on",
            job->remaining, REFERENCE_REMAINING_MAX, count, count > 1 ? "s" : "");
}

static enum status draw_image(struct job *job, struct frame *frame)
{
    const struct renderer_shot *shot = &frame->output.shot;
    if (job->session.reference)
        return trace_image(job, frame);
    if (job->o.image.columns && !job->o.image.tile)
        return draw_tiles(job, shot, &job->result);
    return image_session_draw(&job->session, shot, &job->result, show_progress, job);
}

/* Converts the float image to PNG pixels, for --show, 16 bits, alpha or dithering. */
static bool make_png(const struct job *job, struct render_result *result)
{
    const struct setup_image *p = &job->o.image;
    const bool is_16 = p->png_bits == 16;
    return layer_image_show(p->show ? &result->image : render_result_display(result), p->show,
                            &p->scene.settings, p->ocio ? &job->view : NULL,
                            is_16 ? NULL : &result->rgba, is_16 ? &result->rgba_16 : NULL);
}

static enum status draw(struct job *job, struct frame *frame)
{
    progress_show(&job->progress, 0, job->o.image.samples);
    enum status status = draw_image(job, frame);
    progress_clear(&job->progress);
    job->pixels_beyond += frame->outcome.pixels_beyond;
    job->remaining = fmax(job->remaining, frame->outcome.remaining);
    if (status == STATUS_OK && job->makes_png && !make_png(job, &job->result))
        status = STATUS_TRY_AGAIN;
    return status;
}

/* Returns true if few pixels are drawn. llvmpipe then saves time by optimising shaders less. */
static bool is_small(const struct job *job)
{
    const uint64_t pixels =
        (uint64_t)job->o.image.width * job->o.image.height * job->o.image.samples;
    return pixels <= LAVAPIPE_TUNING_START_SAMPLES / job->sequence.range.count;
}

/* Loads the view of --ocio, if any. */
static enum status load_view(struct job *job)
{
    const struct setup_image *p = &job->o.image;
    const char *comma = p->ocio ? strrchr(p->ocio, ',') : NULL;
    if (!comma)
        return STATUS_OK;
    char *config = strdup(p->ocio);
    if (!config)
        return log_out_of_memory(p->ocio);
    config[comma - p->ocio] = '\0';
    const enum status status = ocio_view_load(&job->view, config, comma + 1, &p->scene.reader);
    free(config);
    return status;
}

/* Chooses the layers and images that the output files need. */
static void choose_outputs(struct job *job)
{
    const struct setup_image *p = &job->o.image;
    const struct setup_outputs *outputs = &job->o.run.outputs;
    struct image_session *session = &job->session;
    for (uint32_t i = 0; i < outputs->count; i++) {
        if (!path_ends_in(outputs->paths[i], ".png"))
            session->linear = true;
        else if (p->show || p->ocio || p->png_bits == 16 || p->scene.no_background ||
                 layer_image_is_dithered(&p->scene.settings))
            job->makes_png = true;
        else
            session->display = true;
    }
    if (session->linear)
        session->layers = p->layers;
    else if (p->layers)
        log_warning("--aov: PNG files have no layers; add an .exr file with --output");
    if (p->ocio && !job->makes_png)
        log_warning("--ocio: EXR files are linear; add a .png file with --output");
    session->layers |= layer_image_bit(p->show);
    session->linear = session->linear || p->is_adaptive;
    session->resolved = job->makes_png && !p->show;
    session->prefers_start = is_small(job);
}

/* Creates the renderer or the path tracer for a frame that has to be drawn. */
static enum status open_renderer(struct job *job)
{
    if (!job->has_outputs)
        choose_outputs(job);
    job->has_outputs = true;
    return image_session_open(&job->session, &job->session.camera);
}

static void print_written(const struct job *job, const struct frame *frame, const char *path)
{
    const struct setup_image *p = &job->o.image;
    const uint32_t samples = frame->output.samples ? frame->output.samples : p->samples;
    const char *name = strcmp(path, "-") ? path : "stdout";
    fprintf(stderr, "%s: %ux%u, ", name, p->width, p->height);
    if (p->is_adaptive)
        fprintf(stderr, "%.3g samples on average", (double)job->result.samples);
    else
        fprintf(stderr, "%u sample%s", samples, samples > 1 ? "s" : "");
    if (frame->output.samples > 1)
        fprintf(stderr, ", noise %.3g", frame->output.noise);
    fputc('\n', stderr);
}

static enum status write_output(struct job *job, const struct frame *frame, const char *path)
{
    /* a termination signal is not delayed while a pipe is written, because writing may block */
    const bool is_direct = file_io_is_direct(path);
    void *data = NULL;
    size_t size = 0;
    const char *device = image_session_device(&job->session);
    enum status status = output_encode(&frame->output, path, &job->result, device, &data, &size);
    if (status == STATUS_OK) {
        if (!is_direct)
            signals_hold(&job->stop);
        status = file_io_write(path, data, size);
        if (!is_direct)
            signals_release(&job->stop);
    }
    free(data);
    if (status == STATUS_OK && !job->o.run.quiet)
        print_written(job, frame, path);
    return status;
}

static enum status write_outputs(struct job *job, const struct frame *frame)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < job->o.run.outputs.count && status == STATUS_OK; i++) {
        if (!frame->is_current[i])
            status = write_output(job, frame, frame->paths[i]);
        else if (!job->o.run.quiet)
            fprintf(stderr, "%s: up to date\n", frame->paths[i]);
    }
    return status;
}

static void record_result(struct job *job, uint32_t index, struct render_report_frame outcome)
{
    signals_hold(&job->stop);
    job->report.frames[index] = outcome;
    signals_release(&job->stop);
}

static enum status run_frame(struct job *job, uint32_t index)
{
    const double begin = clock_seconds();
    struct render_report_frame outcome = { .state = RENDER_REPORT_CURRENT };
    struct frame frame;
    enum status status = frame_init(&frame, job, job->sequence.range.frames[index]);
    if (status == STATUS_OK)
        render_report_hash(frame.output.settings, outcome.hash);
    if (status == STATUS_OK && !frame_is_current(&frame, job->o.run.outputs.count)) {
        outcome.state = RENDER_REPORT_DRAWN;
        status = image_session_pose(&job->session, &frame.output.shot, true);
        if (status == STATUS_OK)
            status = open_renderer(job);
        if (status == STATUS_OK)
            status = draw(job, &frame);
    }
    if (status == STATUS_OK)
        status = write_outputs(job, &frame);
    if (status != STATUS_OK)
        outcome.state = RENDER_REPORT_FAILED;
    outcome.seconds = clock_seconds() - begin;
    record_result(job, index, outcome);
    frame_finish(&frame);
    return status;
}

/* Renders all frames. Stops at the first failure, such as a full disk or a removed folder, because
 * the next frames would fail, too. */
static enum status run_frames(struct job *job)
{
    const uint32_t count = job->sequence.range.count;
    enum status status = STATUS_OK;
    progress_begin(&job->progress, count,
                   job->o.image.refraction == &cpu_reference_settings ? "tiles" : "samples",
                   job->o.run.quiet);
    for (uint32_t i = 0; i < count && status == STATUS_OK; i++) {
        job->progress.frame = i;
        status = run_frame(job, i);
    }
    warn_of_remaining(job);
    return status;
}

static enum status write_report(const struct job *job, int code)
{
    const char *path = job->o.render.json;
    size_t size;
    char *text = render_report_json(&job->report, &job->sequence, &job->o, code, &size);
    enum status status = text ? file_io_write(path, text, size) : log_out_of_memory(NULL);
    free(text);
    return status;
}

/* Writes the report when a signal ends the program. Skips pipes, because writing could block. */
static void write_last_report(void *user, int code)
{
    const struct job *job = user;
    if (job->report.count && !file_io_is_direct(job->o.render.json) &&
        write_report(job, code) != STATUS_OK)
        return; /* write_report() has logged why */
}

/* Returns the camera and the exposure in the report's form. */
static struct render_report_view report_view(const struct job *job)
{
    const struct camera *camera = &job->session.camera;
    const struct model *model = &job->scene.scene.model;
    struct render_report_view view = {
        .fov_deg = camera->height > 0.0f ? 0.0 : (double)camera->fov_deg,
        .exposure = settings_get(&job->o.image.scene.settings, settings_find("tonemap.exposure")),
    };
    for (int i = 0; i < 3; i++) {
        view.eye[i] = world_position_axis(model, camera->eye, i);
        view.target[i] = world_position_axis(model, camera->target, i);
    }
    return view;
}

static enum status begin_report(struct job *job)
{
    struct report report;
    enum status status = render_report_init(&report, job->sequence.range.count);
    report.view = report_view(job);
    signals_hold(&job->stop);
    job->report = report;
    signals_release(&job->stop);
    return status;
}

/* Writes the report at the end of the program. If the arguments were invalid, writes no report. */
static enum status end_report(struct job *job, enum status status)
{
    if (!job->o.render.json || !job->report.frames)
        return status;
    const bool is_direct = file_io_is_direct(job->o.render.json);
    if (!is_direct)
        signals_hold(&job->stop);
    const enum status written = write_report(job, (int)status);
    if (!is_direct)
        signals_release(&job->stop);
    return status == STATUS_OK ? written : status;
}

/* Runs the command. All errors in arguments and files are found before the device is opened. */
static enum status run(struct job *job)
{
    enum status status = sequence_parse(&job->sequence, &job->o);
    if (status == STATUS_OK)
        status = sequence_check(&job->sequence, &job->o);
    if (status == STATUS_OK && job->o.render.json)
        status = file_io_check(job->o.render.json);
    if (status == STATUS_OK)
        status = load_view(job);
    if (status == STATUS_OK)
        status = setup_begin_scene(&job->scene.scene, &job->o.image.scene);
    if (status == STATUS_OK)
        status = image_session_choose(&job->session);
    if (status == STATUS_OK)
        status = output_check_tiles(&job->o.image, &job->o.run.outputs);
    if (status == STATUS_OK)
        status = begin_report(job);
    if (status == STATUS_OK)
        status = run_frames(job);
    if (status == STATUS_OK && job->gpu.message_count)
        status = STATUS_FAILED; /* the validation layer has logged why */
    return end_report(job, status);
}

enum status app_render(const struct app_options *options)
{
    struct job *job = calloc(1, sizeof(*job));
    if (!job)
        return log_out_of_memory(NULL);
    job->o = *options;
    job->session = (struct image_session){
        .image = &job->o.image,
        .scene = &job->scene,
        .gpu = &job->gpu,
        .gpu_params = &job->o.run.gpu,
        .quiet = job->o.run.quiet,
        .noise = job->o.render.noise,
        .seconds = job->o.render.seconds,
    };
    if (job->o.render.json)
        job->stop = (struct signals){ .last = write_last_report, .user = job };
    enum status status = signals_begin(&job->stop);
    if (status == STATUS_OK)
        status = run(job);
    signals_end(&job->stop);
    image_session_close(&job->session);
    render_result_finish(&job->result);
    gpu_destroy(&job->gpu);
    ocio_view_finish(&job->view);
    scene_finish(&job->scene.scene);
    render_report_finish(&job->report);
    sequence_finish(&job->sequence);
    free(job);
    return status;
}
