/*
 * memory_stream.h: open_memstream() and fmemopen() for writing, for C libraries without POSIX, on
 * temporary files. Included before each source of the tests.
 */
#ifndef TESTS_STANDALONE_MEMORY_STREAM_H
#define TESTS_STANDALONE_MEMORY_STREAM_H

#include <stdio.h>

FILE *memory_stream_open(char **text, size_t *size);
FILE *memory_stream_open_fixed(void *buffer, size_t size, const char *mode);
int memory_stream_close(FILE *file); /* also of other files */

#define open_memstream memory_stream_open
#define fmemopen       memory_stream_open_fixed
#define fclose         memory_stream_close

#endif
