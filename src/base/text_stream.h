/* text_stream.h: output stream that collects text in memory. */
#ifndef FIRN_BASE_TEXT_STREAM_H
#define FIRN_BASE_TEXT_STREAM_H

#include <stddef.h>
#include <stdio.h>

/* Stream that is open. Must not move. */
struct text_stream {
    FILE *file;
    char *text;
    size_t size;
};

/* Opens a stream and returns its FILE, to which the caller writes. Returns NULL on failure, after
 * which text_stream_close() also returns NULL. */
FILE *text_stream_open(struct text_stream *stream);

/* Closes a stream and returns its text, which ends with '\0' and which the caller frees. Writes the
 * length of the text to *length, which may be NULL. Returns NULL if out of memory. */
char *text_stream_close(struct text_stream *stream, size_t *length);

#endif
