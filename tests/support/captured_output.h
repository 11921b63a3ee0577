/* captured_output.h: captures what a function writes to a FILE as a string. */
#ifndef TESTS_SUPPORT_CAPTURED_OUTPUT_H
#define TESTS_SUPPORT_CAPTURED_OUTPUT_H

#include <stdio.h>

/* Output captured between captured_output_begin() and _end(); the test frees `text`. */
struct printed {
    FILE *out;
    char *text;
    size_t size;
};

FILE *captured_output_begin(struct printed *printed);

/* Ends the capture. Fails if a line exceeds `columns` characters or has control characters. */
void captured_output_end(struct printed *printed, int columns);

/* Returns the line that begins with `words`; fails if there is none. */
const char *captured_output_line(const struct printed *printed, const char *words);

#endif
