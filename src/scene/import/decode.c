/* decode.c: models, panoramas and pictures through a reader process: both of its ends. */
#include "src/scene/import/decode.h"
#include <unistd.h>
#include "src/base/log.h"
#include "src/reader/picture_reader.h"
#include "src/reader/preset.h"
#include "src/scene/import/mesh_pipe.h"

enum status decode_model(struct model *model, const char *path, enum model_part everything_is,
                         const struct reader_params *params)
{
    struct reader *reader;
    if (!params)
        return model_load(model, path, everything_is);
    *model = (struct model){ 0 };
    const enum reader_kind kind =
        everything_is == MODEL_OBJECT ? READER_OBJECT : READER_SURROUNDINGS;
    const enum status status = reader_start(&reader, params, kind, path);
    if (status != STATUS_OK)
        return status;
    const struct pipe_source source = reader_source(reader);
    return reader_end(reader, mesh_pipe_read_model(&source, model));
}

enum status decode_environment(struct environment *environment, const char *path,
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
    return reader_end(reader, mesh_pipe_read_environment(&source, environment));
}

/* ---- in the child ---- */

static enum status send_model(const struct reader_job *job)
{
    const enum model_part part = job->kind == READER_OBJECT ? MODEL_OBJECT : MODEL_SURROUNDINGS;
    struct model model;
    enum status status = model_load(&model, job->path, part);
    if (status == STATUS_OK && !mesh_pipe_write_model(&reader_sink, &model))
        status = STATUS_WRITE;
    model_finish(&model);
    return status;
}

static enum status send_environment(const struct reader_job *job)
{
    struct environment environment;
    enum status status = environment_load(&environment, job->path);
    if (status == STATUS_OK && !mesh_pipe_write_environment(&reader_sink, &environment))
        status = STATUS_WRITE;
    environment_finish(&environment);
    return status;
}

static enum status send_file(const struct reader_job *job)
{
    switch (job->kind) {
    case READER_OBJECT:
    case READER_SURROUNDINGS:
        return send_model(job);
    case READER_ENVIRONMENT:
        return send_environment(job);
    case READER_PICTURE:
        return picture_send(job->path, &reader_sink);
    case READER_PICTURE_CHECK:
        return picture_send_check(job->path, &reader_sink);
    case READER_PRESET:
        return preset_send(job->path, &reader_sink);
    case READER_KIND_COUNT:
        break;
    }
    return STATUS_USAGE;
}

int decode_main(int argc, char **argv)
{
    struct reader_job job;
    if (!reader_enter(argc, argv, &job)) {
        log_error(READER_WORD ": for internal use by firn only");
        return STATUS_USAGE;
    }
    _exit((int)send_file(&job)); /* no exit handler runs in a process that has parsed the file */
}
