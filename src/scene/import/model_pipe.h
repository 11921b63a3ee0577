/*
 * model_pipe.h: serialises models and environment maps over a pipe between two processes.
 *
 * The writer has parsed an untrusted file, so the reader validates everything: counts and sizes are
 * checked before memory is allocated, every index must be below its vertex count, every number
 * finite, and extra or missing bytes are a fault. Numbers are in the machine's representation.
 */
#ifndef FIRN_SCENE_IMPORT_MODEL_PIPE_H
#define FIRN_SCENE_IMPORT_MODEL_PIPE_H

#include "src/file/reader_pipe.h"
#include "src/scene/environment/environment.h"
#include "src/scene/import/model.h"

/* Sends a model to a sink. Returns false if writing fails. */
MUST_USE bool model_pipe_write_model(const struct pipe_sink *sink, const struct model *model);
MUST_USE bool model_pipe_write_environment(const struct pipe_sink *sink,
                                           const struct environment *environment);

/* Receives and validates a model. A fault zeroes *model, but is not logged. */
MUST_USE enum pipe_fault model_pipe_read_model(const struct pipe_source *source,
                                               struct model *model);
MUST_USE enum pipe_fault model_pipe_read_environment(const struct pipe_source *source,
                                                     struct environment *environment);

#endif
