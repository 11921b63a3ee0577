/* text_stream_win.c: text streams by temporary files, since Windows has no streams in memory. */
#include <stdbool.h>
#include <stdlib.h>
#include "src/base/text_stream.h"

FILE *text_stream_open(struct text_stream *stream)
{
    *stream = (struct text_stream){ .file = tmpfile() };
    return stream->file;
}

/* Reads the file into stream->text. Returns false on failure. */
static bool read_back(struct text_stream *stream)
{
    const long size = ftell(stream->file);
    stream->text = size >= 0 ? malloc((size_t)size + 1) : NULL;
    if (!stream->text)
        return false;
    rewind(stream->file);
    stream->size = (size_t)size;
    stream->text[stream->size] = '\0';
    return fread(stream->text, 1, stream->size, stream->file) == stream->size;
}

char *text_stream_close(struct text_stream *stream, size_t *length)
{
    const bool is_good = stream->file && !ferror(stream->file) && read_back(stream);
    if (stream->file)
        fclose(stream->file);
    if (length)
        *length = stream->size;
    if (is_good)
        return stream->text;
    free(stream->text);
    return NULL;
}
