/*
 * mesh_pipe.h: sends a model or a panorama between two processes of the same program.
 *
 * The writer has parsed an untrusted file, so the reader validates everything: counts and sizes are
 * checked before memory is allocated, every index must be below its vertex count, every number
 * finite, and extra or missing bytes are a fault. Numbers have the machine's representation.
 */
#ifndef FIRN_SCENE_IMPORT_MESH_PIPE_H
#define FIRN_SCENE_IMPORT_MESH_PIPE_H

#include "src/scene/environment.h"
#include "src/scene/import/model.h"

/* Read or write `size` bytes. They return false if not all bytes could be transferred; no further
 * call follows. */
typedef bool mesh_pipe_read_fn(void *user, void *bytes, size_t size);
typedef bool mesh_pipe_write_fn(void *user, const void *bytes, size_t size);

struct mesh_pipe_source {
    mesh_pipe_read_fn *read;
    void *user;
    uint64_t size_max; /* limit of the bytes of all arrays together */
};

struct mesh_pipe_sink {
    mesh_pipe_write_fn *write;
    void *user;
};

enum mesh_pipe_fault {
    MESH_PIPE_OK,
    MESH_PIPE_SHORT,  /* the source ended early */
    MESH_PIPE_MEMORY, /* out of memory; the bytes may be valid */
    MESH_PIPE_HEAD,
    MESH_PIPE_SIZE,
    MESH_PIPE_NUMBER,
    MESH_PIPE_INDEX,
    MESH_PIPE_MATERIAL,
    MESH_PIPE_CAMERA,
    MESH_PIPE_TEXEL,
    MESH_PIPE_END,
    MESH_PIPE_FAULT_COUNT,
};

/* Returns a description such as "an index beyond the vertices". */
const char *mesh_pipe_words(enum mesh_pipe_fault fault);

/* Return false if the sink's write function does. */
MUST_USE bool mesh_pipe_write_model(const struct mesh_pipe_sink *sink, const struct model *model);
MUST_USE bool mesh_pipe_write_environment(const struct mesh_pipe_sink *sink,
                                          const struct environment *environment);

/* Read and validate. On any fault *model or *environment is {0}. Nothing is logged. */
MUST_USE enum mesh_pipe_fault mesh_pipe_read_model(const struct mesh_pipe_source *source,
                                                   struct model *model);
MUST_USE enum mesh_pipe_fault mesh_pipe_read_environment(const struct mesh_pipe_source *source,
                                                         struct environment *environment);

#endif
