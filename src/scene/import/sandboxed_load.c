/* sandboxed_load.c: loads models, environment maps and images through a sandboxed reader process:
 * the parent's side and the child's side. */
#include "src/scene/import/sandboxed_load.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "src/base/log.h"
#include "src/file/image_receive.h"
#include "src/file/ocio_view.h"
#include "src/file/preset.h"
#include "src/scene/import/model_pipe.h"

/* Encodes a pose as an argument for the child process. The caller frees the text. Line 1 has a
 * mark, the time and the origin's coordinates as hexadecimal floats (NaN if the origin is not
 * given) and the animation name, separated by spaces. The mark is '-' (rest pose), '*' (first
 * animation) or '=' (named animation). The other lines are object names. */
static char *encode_pose(const struct model_pose *pose)
{
    const char *mark = pose->animation ? "=" : pose->is_first ? "*" : "-";
    const char *name = pose->animation ? pose->animation : "";
    const char *objects = pose->objects ? pose->objects : "";
    static const double unknown[3] = { (double)NAN, (double)NAN, (double)NAN };
    const double *origin = pose->origin ? pose->origin : unknown;
    const size_t size = strlen(name) + strlen(objects) + 160;
    char *text = malloc(size);
    if (text)
        (void)snprintf(text, size, "%s%a %a %a %a %s\n%s", mark, (double)pose->time, origin[0],
                       origin[1], origin[2], name, objects);
    return text;
}

/* Decodes a pose. Modifies `text` and `origin`, to which the pose points. */
static struct model_pose decode_pose(char *text, double origin[static 3])
{
    struct model_pose pose = { .is_first = text[0] == '*' };
    char *end = strchr(text, '\n');
    if (end) {
        *end = '\0';
        pose.objects = end + 1;
    }
    if (text[0] == '\0')
        return pose;
    pose.time = strtof(&text[1], &end);
    for (int k = 0; k < 3; k++)
        origin[k] = strtod(end, &end);
    pose.origin = isfinite(origin[0]) ? origin : NULL;
    if (text[0] == '=' && *end == ' ')
        pose.animation = end + 1;
    return pose;
}

static const enum reader_kind reader_kinds[] = {
    [MODEL_OBJECT] = READER_OBJECT,
    [MODEL_SURROUNDINGS] = READER_SURROUNDINGS,
    [MODEL_BY_MATERIALS] = READER_BY_MATERIALS,
};

enum status sandboxed_load_model(struct model *model, const char *path,
                                 enum model_role default_role, const struct model_pose *pose,
                                 const struct reader_params *params)
{
    static const struct model_pose at_rest = { 0 };
    struct reader *reader;
    if (!params)
        return model_load_posed(model, path, default_role, pose ? pose : &at_rest);
    *model = (struct model){ 0 };
    struct reader_params posed = *params;
    char *text = encode_pose(pose ? pose : &at_rest);
    if (!text)
        return log_out_of_memory(path);
    posed.details = text;
    enum status status = reader_start(&reader, &posed, reader_kinds[default_role], path);
    if (status == STATUS_OK) {
        const struct pipe_source source = reader_source(reader);
        status = reader_end(reader, model_pipe_read_model(&source, model));
    }
    free(text);
    return status;
}

enum status sandboxed_load_environment(struct environment *environment, const char *path,
                                       const struct reader_params *params)
{
    struct reader *reader;
    if (!params)
        return environment_load(environment, path);
    *environment = (struct environment){ 0 };
    const enum status status = reader_start(&reader, params, READER_ENVIRONMENT, path);
    if (status != STATUS_OK)
        return status;
    const struct pipe_source source = reader_source(reader);
    return reader_end(reader, model_pipe_read_environment(&source, environment));
}

/* ---- in the child process ---- */

static enum status send_model(const struct reader_job *job)
{
    enum model_role part = MODEL_OBJECT;
    struct model model;
    while (reader_kinds[part] != job->kind)
        part++;
    char *details = strdup(job->details);
    if (!details)
        return log_out_of_memory(job->path);
    double origin[3];
    const struct model_pose pose = decode_pose(details, origin);
    enum status status = model_load_posed(&model, job->path, part, &pose);
    if (status == STATUS_OK && !model_pipe_write_model(&reader_sink, &model))
        status = STATUS_WRITE;
    free(details);
    model_finish(&model);
    return status;
}

static enum status send_environment(const struct reader_job *job)
{
    struct environment environment;
    enum status status = environment_load(&environment, job->path);
    if (status == STATUS_OK && !model_pipe_write_environment(&reader_sink, &environment))
        status = STATUS_WRITE;
    environment_finish(&environment);
    return status;
}

static enum status send_file(const struct reader_job *job)
{
    switch (job->kind) {
    case READER_OBJECT:
    case READER_SURROUNDINGS:
    case READER_BY_MATERIALS:
        return send_model(job);
    case READER_ENVIRONMENT:
        return send_environment(job);
    case READER_IMAGE:
        return image_send(job->path, &reader_sink);
    case READER_IMAGE_CHECK:
        return image_send_header(job->path, &reader_sink);
    case READER_OCIO:
        return ocio_view_send(job->path, job->details, &reader_sink);
    case READER_PRESET:
        return preset_send(job->path, &reader_sink);
    case READER_KIND_COUNT:
        break;
    }
    return STATUS_USAGE;
}

int sandboxed_load_main(int argc, char **argv)
{
    struct reader_job job;
    if (!reader_enter(argc, argv, &job)) {
        log_error(READER_OPTION ": for internal use by firn only");
        return STATUS_USAGE;
    }
    _Exit((int)send_file(&job)); /* skips possibly compromised exit handlers */
}
