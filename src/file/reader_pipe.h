/*
 * reader_pipe.h: validated byte stream from a reader process to its parent process. The reader
 * parses untrusted files, so the parent checks all data that it receives. It checks counts and
 * sizes before it allocates memory. Extra or missing bytes are a fault. Numbers have native format.
 */
#ifndef FIRN_FILE_READER_PIPE_H
#define FIRN_FILE_READER_PIPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include "src/base/status.h"

/* Callback that transfers `size` bytes. After returning false, it must not be called again. */
typedef bool pipe_read_fn(void *user, void *bytes, size_t size);
typedef bool pipe_write_fn(void *user, const void *bytes, size_t size);

struct pipe_source {
    pipe_read_fn *read;
    void *user;
    uint64_t size_max; /* limit of all arrays, bytes */
};

struct pipe_sink {
    pipe_write_fn *write;
    void *user;
};

enum pipe_fault {
    PIPE_OK,
    PIPE_SHORT,  /* the source ended early */
    PIPE_MEMORY, /* out of memory, data possibly valid */
    PIPE_LARGE,  /* valid, but above a user's limit */
    PIPE_HEAD,
    PIPE_SIZE,
    PIPE_NUMBER,
    PIPE_INDEX,
    PIPE_MATERIAL,
    PIPE_CAMERA,
    PIPE_TEXEL,
    PIPE_TEXT,
    PIPE_END,
    PIPE_FAULT_COUNT,
};

/* Returns the description of a fault, such as "an index beyond the vertices". */
const char *pipe_fault_text(enum pipe_fault fault);

/* Writes `size` bytes, which pipe_read() receives. `bytes` may be NULL if `size` is 0. */
MUST_USE bool pipe_write(const struct pipe_sink *sink, const void *bytes, size_t size);
MUST_USE enum pipe_fault pipe_read(const struct pipe_source *source, void *bytes, size_t size);

/* Returns true if a received bool is 0 or 1; reading any other value is undefined. */
static inline bool pipe_is_bool(const bool *value)
{
    unsigned char byte;
    memcpy(&byte, value, sizeof(byte));
    return byte <= 1;
}

/* Writes the marker that ends every stream. pipe_read_end() checks the marker. */
MUST_USE bool pipe_write_end(const struct pipe_sink *sink);
MUST_USE enum pipe_fault pipe_read_end(const struct pipe_source *source);

#endif
