/* printed.h: captures what a function writes to a FILE as a string. */
#ifndef TESTS_PRINTED_H
#define TESTS_PRINTED_H

#include <stdio.h>

/* FILE *out = printed_begin(&printed); ... printed_end(&printed); ... free(printed.text) */
struct printed {
    FILE *out;
    char *text;
    size_t size;
};

FILE *printed_begin(struct printed *printed);

/* Fails where a line has more than `columns` characters, or text is no UTF-8. */
void printed_end(struct printed *printed, int columns);

/* The line that begins with these words; fails if there is none. */
const char *printed_line(const struct printed *printed, const char *words);

#endif
