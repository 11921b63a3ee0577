/*
 * pipe.h: the bytes between a reader process and its parent.
 *
 * The writer has parsed an untrusted file, so what reads from the pipe validates everything: counts
 * and sizes are checked before memory is allocated, and extra or missing bytes are a fault. Numbers
 * have the machine's representation.
 */
#ifndef FIRN_READER_PIPE_H
#define FIRN_READER_PIPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "src/base/status.h"

/* Read or write `size` bytes. They return false if not all bytes could be transferred; no further
 * call follows. */
typedef bool pipe_read_fn(void *user, void *bytes, size_t size);
typedef bool pipe_write_fn(void *user, const void *bytes, size_t size);

struct pipe_source {
    pipe_read_fn *read;
    void *user;
    uint64_t size_max; /* limit of the bytes of all arrays together */
};

struct pipe_sink {
    pipe_write_fn *write;
    void *user;
};

enum pipe_fault {
    PIPE_OK,
    PIPE_SHORT,  /* the source ended early */
    PIPE_MEMORY, /* out of memory; the bytes may be valid */
    PIPE_LARGE,  /* valid, but above a limit that the user may raise */
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

/* Returns a description such as "an index beyond the vertices". */
const char *pipe_words(enum pipe_fault fault);

/* Sends or receives bytes, which may be none: then `bytes` may be NULL. */
MUST_USE bool pipe_write(const struct pipe_sink *sink, const void *bytes, size_t size);
MUST_USE enum pipe_fault pipe_read(const struct pipe_source *source, void *bytes, size_t size);

/* The word that ends all data. */
MUST_USE bool pipe_write_end(const struct pipe_sink *sink);
MUST_USE enum pipe_fault pipe_read_end(const struct pipe_source *source);

#endif
