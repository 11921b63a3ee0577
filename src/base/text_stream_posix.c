/* text_stream_posix.c: text streams by open_memstream(). */
#include <stdbool.h>
#include <stdlib.h>
#include "src/base/text_stream.h"

FILE *text_stream_open(struct text_stream *stream)
{
    *stream = (struct text_stream){ 0 };
    stream->file = open_memstream(&stream->text, &stream->size);
    return stream->file;
}

char *text_stream_close(struct text_stream *stream, size_t *length)
{
    const bool is_good = stream->file && !ferror(stream->file);
    const bool is_closed = stream->file && fclose(stream->file) == 0;
    if (length)
        *length = stream->size;
    if (is_good && is_closed)
        return stream->text;
    free(stream->text);
    return NULL;
}
