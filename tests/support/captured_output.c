/* captured_output.c: captures what a function writes to a FILE as a string. */
#include "tests/support/captured_output.h"
#include <stdlib.h>
#include <string.h>
#include "tests/support/assertions.h"

FILE *captured_output_begin(struct printed *printed)
{
    *printed = (struct printed){ 0 };
    printed->out = open_memstream(&printed->text, &printed->size);
    assert_non_null(printed->out);
    return printed->out;
}

void captured_output_end(struct printed *printed, int columns)
{
    int column = 0;
    assert_int_equal(fclose(printed->out), 0);
    for (const char *at = printed->text; *at; at++) {
        const unsigned char c = (unsigned char)*at;
        column += (c & 0xc0) != 0x80; /* count characters: skip UTF-8 continuation bytes */
        if (c == '\n')
            column = 0;
        if (column > columns)
            fail_msg("more than %d columns:\n%s", columns, printed->text);
        assert_true(c == '\n' || c >= ' ');
    }
    assert_int_equal(column, 0);
}

const char *captured_output_line(const struct printed *printed, const char *words)
{
    const char *line = printed->text;
    while (line && strncmp(line, words, strlen(words)) != 0) {
        const char *end = strchr(line, '\n');
        line = end ? end + 1 : NULL;
    }
    if (!line)
        fail_msg("no line \"%s\" in:\n%s", words, printed->text);
    return line;
}
