/* sequence_frame_list.c: frame list, frame times and output file names of a command line. */
#include "src/app/sequence_frame_list.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/base/path.h"
#include "src/file/atomic_file.h"
#include "src/settings/scene_settings.h"
#include "src/setup/image_output.h"

static enum status parse_frames(struct sequence *sequence, const struct app_options *o)
{
    if (o->render.frames)
        return frame_range_parse(&sequence->range, o->render.frames);
    sequence->range.frames = calloc(1, sizeof(*sequence->range.frames));
    sequence->range.count = 1;
    return sequence->range.frames ? STATUS_OK : log_out_of_memory(NULL);
}

/* Keeps only the frames of --chunk. Call it after parse_names(), which needs all frames. */
static enum status apply_chunk(struct sequence *sequence, const struct app_options *o)
{
    if (!o->render.frames) {
        log_error("--chunk %u/%u: --frames is missing", o->render.chunk, o->render.chunk_count);
        return STATUS_USAGE;
    }
    frame_range_chunk(&sequence->range, o->render.chunk, o->render.chunk_count);
    if (!sequence->range.count && !o->run.quiet)
        fprintf(stderr, "--chunk %u/%u: contains no frames\n", o->render.chunk,
                o->render.chunk_count);
    return STATUS_OK;
}

static enum status parse_name(struct sequence *sequence, const struct app_options *o, uint32_t i)
{
    const char *path = o->run.outputs.paths[i];
    const uint32_t count = sequence->range.count;
    struct frame_name *name = &sequence->names[i];

    *name = (struct frame_name){ .path = path };
    if (!o->render.frames) {
        if (!frame_name_is_pattern(path))
            return STATUS_OK;
        log_error("--output %s: has a frame number, but --frames is missing", path);
        return STATUS_USAGE;
    }
    enum status status = frame_name_parse(name, path);
    if (status != STATUS_OK || count == 1 || name->length)
        return status;
    if (!strcmp(path, "-"))
        log_error("--output: expected a file name for %u frames, got '-': stdout can hold only one "
                  "image",
                  count);
    else
        log_error(
            "--output: expected a frame number for %u frames, such as #### or %%04d, got '%s'",
            count, path);
    return STATUS_USAGE;
}

static enum status parse_names(struct sequence *sequence, struct app_options *o)
{
    struct setup_outputs *outputs = &o->run.outputs;
    enum status status = STATUS_OK;
    bool stdout_taken = o->render.json && !strcmp(o->render.json, "-");
    bool has_png = false;
    app_default_output(o, APP_RENDER);
    for (uint32_t i = 0; i < outputs->count && status == STATUS_OK; i++) {
        const bool is_stdout = !strcmp(outputs->paths[i], "-");
        if (is_stdout && stdout_taken) {
            log_error("stdout can hold only one image or report, but '-' is given twice");
            return STATUS_USAGE;
        }
        stdout_taken = stdout_taken || is_stdout;
        has_png = has_png || path_ends_in(outputs->paths[i], ".png");
        status = parse_name(sequence, o, i);
    }
    if (status == STATUS_OK && o->image.show && !has_png) {
        log_error("--show %s: only PNG files show a layer; add one with -o FILE.png",
                  o->image.show->name);
        return STATUS_USAGE;
    }
    return status;
}

enum status sequence_parse(struct sequence *sequence, struct app_options *o)
{
    enum status status = parse_frames(sequence, o);
    if (status == STATUS_OK)
        status = parse_names(sequence, o);
    if (status == STATUS_OK && o->render.chunk)
        status = apply_chunk(sequence, o);
    return status;
}

double sequence_time(const struct settings *settings, int32_t frame)
{
    const struct motion_params *motion = settings_of(settings, &motion_settings);
    return (double)motion->time + frame / (double)motion->fps;
}

static enum status check_frame(const struct sequence *sequence, const struct app_options *o,
                               int32_t frame)
{
    const struct setting *row = settings_find("motion.time");
    const double time = sequence_time(&o->image.scene.settings, frame);
    enum status status = STATUS_OK;
    if (time < row->min || time > row->max) {
        log_error("--frames %s: frame %d is at %.7g seconds (motion.time + frame / motion.fps), "
                  "expected %.7g to %.7g seconds",
                  o->render.frames, (int)frame, time, row->min, row->max);
        return STATUS_USAGE;
    }
    for (uint32_t i = 0; i < o->run.outputs.count && status == STATUS_OK; i++) {
        char *path = frame_name_make(&sequence->names[i], frame);
        status = path ? file_io_check(path) : log_out_of_memory(NULL);
        free(path);
    }
    return status;
}

enum status sequence_check(const struct sequence *sequence, const struct app_options *o)
{
    enum status status = STATUS_OK;
    for (uint32_t i = 0; i < sequence->range.count && status == STATUS_OK; i++)
        status = check_frame(sequence, o, sequence->range.frames[i]);
    return status;
}

void sequence_finish(struct sequence *sequence)
{
    frame_range_finish(&sequence->range);
}
