/* memory_stream.c: copies a temporary file to memory when it is closed. */
#include "tests/standalone/memory_stream.h"
#include <stdlib.h>
#include <string.h>

#undef fclose

enum {
    STREAM_COUNT = 8, /* open at a time */
};

struct stream {
    FILE *file; /* NULL: free */
    char **text;
    size_t *size;
    char *buffer; /* of the caller, instead of `text` */
    size_t room;
};

static struct stream streams[STREAM_COUNT];

static FILE *open_stream(struct stream stream)
{
    stream.file = tmpfile();
    for (int i = 0; stream.file && i < STREAM_COUNT; i++) {
        if (streams[i].file)
            continue;
        streams[i] = stream;
        return stream.file;
    }
    return NULL;
}

FILE *memory_stream_open(char **text, size_t *size)
{
    return open_stream((struct stream){ .text = text, .size = size });
}

FILE *memory_stream_open_fixed(void *buffer, size_t size, const char *mode)
{
    (void)mode;
    return open_stream((struct stream){ .buffer = buffer, .room = size });
}

/* Copies what has been written, with a terminating 0 if there is room. */
static int finish(const struct stream *stream)
{
    const long end = ftell(stream->file);
    size_t size = end > 0 ? (size_t)end : 0;
    char *to = stream->buffer;
    if (stream->text) {
        to = *stream->text = calloc(size + 1, 1);
        *stream->size = size;
    } else if (size > stream->room) {
        size = stream->room;
    } else if (size < stream->room) {
        to[size] = 0;
    }
    rewind(stream->file);
    return to && fread(to, 1, size, stream->file) == size ? 0 : EOF;
}

int memory_stream_close(FILE *file)
{
    int result = 0;
    for (int i = 0; i < STREAM_COUNT; i++) {
        if (streams[i].file != file)
            continue;
        result = finish(&streams[i]);
        streams[i].file = NULL;
    }
    return fclose(file) == 0 ? result : EOF;
}
