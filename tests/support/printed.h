/* printed.h: captures what a function writes to a FILE as a string. */
#ifndef TESTS_PRINTED_H
#define TESTS_PRINTED_H

#include <stdio.h>

/* Use: FILE *out = printed_begin(&printed); ... printed_end(&printed); ... free(printed.text) */
struct printed {
    FILE *out;
    char *text;
    size_t size;
};

FILE *printed_begin(struct printed *printed);

/* Ends the capture. Fails if a line has more than `columns` characters, or control characters. */
void printed_end(struct printed *printed, int columns);

/* Returns the line that begins with `words`; fails if there is none. */
const char *printed_line(const struct printed *printed, const char *words);

#endif
