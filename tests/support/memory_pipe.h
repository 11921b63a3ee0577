/* memory_pipe.h: in-memory pipe, a fake of the reader processes' pipe (src/file/reader_pipe.h).
 */
#ifndef TESTS_SUPPORT_MEMORY_PIPE_H
#define TESTS_SUPPORT_MEMORY_PIPE_H

#include <string.h>
#include "src/file/reader_pipe.h"

enum {
    MEMORY_PIPE_SIZE = 8192
};

struct memory_pipe {
    unsigned char bytes[MEMORY_PIPE_SIZE];
    size_t size, at; /* bytes written, bytes read */
};

/* Callbacks of a struct pipe_sink and a struct pipe_source; `user` is a struct memory_pipe. */
static inline bool memory_pipe_write(void *user, const void *bytes, size_t size)
{
    struct memory_pipe *stream = user;
    if (size > MEMORY_PIPE_SIZE - stream->size)
        return false;
    memcpy(stream->bytes + stream->size, bytes, size);
    stream->size += size;
    return true;
}

static inline bool memory_pipe_read(void *user, void *bytes, size_t size)
{
    struct memory_pipe *stream = user;
    if (size > stream->size - stream->at)
        return false;
    memcpy(bytes, stream->bytes + stream->at, size);
    stream->at += size;
    return true;
}

#endif
