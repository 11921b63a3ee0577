/* pipe_stream.h: in-memory pipe, a fake of the reader processes' pipe (src/reader/pipe.h). */
#ifndef TESTS_PIPE_STREAM_H
#define TESTS_PIPE_STREAM_H

#include <string.h>
#include "src/reader/pipe.h"

enum {
    PIPE_STREAM_SIZE = 4096
};

struct pipe_stream {
    unsigned char bytes[PIPE_STREAM_SIZE];
    size_t size, at; /* bytes written, bytes read */
};

/* Callbacks of a struct pipe_sink and a struct pipe_source; `user` is the stream. */
static inline bool pipe_stream_write(void *user, const void *bytes, size_t size)
{
    struct pipe_stream *stream = user;
    if (size > PIPE_STREAM_SIZE - stream->size)
        return false;
    memcpy(stream->bytes + stream->size, bytes, size);
    stream->size += size;
    return true;
}

static inline bool pipe_stream_read(void *user, void *bytes, size_t size)
{
    struct pipe_stream *stream = user;
    if (size > stream->size - stream->at)
        return false;
    memcpy(bytes, stream->bytes + stream->at, size);
    stream->at += size;
    return true;
}

#endif
