/*
 * mesh_pipe.h: a model or a panorama as bytes between two processes of the same program.
 *
 * Who writes has read a file that nobody vouches for, so the reader takes nothing on trust: counts
 * and sizes are checked before memory is allocated, every index is below its vertex count, every
 * number is finite, and what is left over or missing is a fault. Numbers are as the machine has
 * them.
 */
#ifndef FIRN_SCENE_IMPORT_MESH_PIPE_H
#define FIRN_SCENE_IMPORT_MESH_PIPE_H

#include "src/scene/environment.h"
#include "src/scene/import/model.h"

/* False: not all of them could be read, or written, and none will be. */
typedef bool mesh_pipe_read_fn(void *user, void *bytes, size_t size);
typedef bool mesh_pipe_write_fn(void *user, const void *bytes, size_t size);

struct mesh_pipe_source {
    mesh_pipe_read_fn *read;
    void *user;
    uint64_t size_max; /* bytes of all arrays together */
};

struct mesh_pipe_sink {
    mesh_pipe_write_fn *write;
    void *user;
};

enum mesh_pipe_fault {
    MESH_PIPE_OK,
    MESH_PIPE_SHORT,  /* the source ended */
    MESH_PIPE_MEMORY, /* none is left; the bytes may be fine */
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

/* "an index beyond the vertices" */
const char *mesh_pipe_words(enum mesh_pipe_fault fault);

/* False when the sink takes no more. */
MUST_USE bool mesh_pipe_write_model(const struct mesh_pipe_sink *sink, const struct model *model);
MUST_USE bool mesh_pipe_write_environment(const struct mesh_pipe_sink *sink,
                                          const struct environment *environment);

/* What is not MESH_PIPE_OK leaves a {0}. Nothing is logged. */
MUST_USE enum mesh_pipe_fault mesh_pipe_read_model(const struct mesh_pipe_source *source,
                                                   struct model *model);
MUST_USE enum mesh_pipe_fault mesh_pipe_read_environment(const struct mesh_pipe_source *source,
                                                         struct environment *environment);

#endif
