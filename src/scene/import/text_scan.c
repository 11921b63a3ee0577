/* text_scan.c: tokeniser for text model files. */
#include "src/scene/import/text_scan.h"
#include <stdlib.h>
#include <string.h>
#include "src/base/ascii.h"

struct text_scan text_line(struct text_scan *scan)
{
    struct text_scan line = *scan;
    const char *end = scan->end;
    const char *at = scan->at;
    while (at < end && !text_is_break(*at))
        at++;
    line.end = at;
    if (at < end)
        at += *at == '\r' && at + 1 < end && at[1] == '\n' ? 2 : 1;
    scan->at = at;
    return line;
}

struct text_scan text_word(struct text_scan *scan)
{
    (void)text_skip(scan);
    struct text_scan word = { scan->at, scan->at };
    while (word.end < scan->end && !text_is_blank(*word.end))
        word.end++;
    scan->at = word.end;
    return word;
}

bool text_take_word(struct text_scan *scan, const char *word)
{
    struct text_scan next = *scan;
    const struct text_scan found = text_word(&next);
    const size_t length = strlen(word);
    if ((size_t)(found.end - found.at) != length || !ascii_begins_equal(found.at, word, length))
        return false;
    *scan = next;
    return true;
}

struct text_scan text_rest(const struct text_scan *line)
{
    struct text_scan rest = *line;
    (void)text_skip(&rest);
    while (rest.end > rest.at && text_is_blank(rest.end[-1]))
        rest.end--;
    return rest;
}

bool text_float(struct text_scan *scan, float *value)
{
    char *end;
    if (!text_skip(scan) || text_is_break(*scan->at))
        return false;
    const float number = strtof(scan->at, &end);
    if (end == scan->at || end > scan->end ||
        (end < scan->end && !text_is_blank(*end) && !text_is_break(*end)))
        return false;
    *value = number;
    scan->at = end;
    return true;
}

bool text_integer(struct text_scan *scan, int64_t *value)
{
    (void)text_skip(scan);
    const char *at = scan->at;
    const bool is_negative = at < scan->end && *at == '-';
    at += at < scan->end && (*at == '-' || *at == '+');
    const char *first = at;
    int64_t number = 0;
    for (; at < scan->end && *at >= '0' && *at <= '9'; at++)
        number = number <= INT64_MAX / 20 ? number * 10 + (*at - '0') : number;
    if (at == first)
        return false;
    *value = is_negative ? -number : number;
    scan->at = at;
    return true;
}

uint32_t text_floats(struct text_scan *scan, float *values, uint32_t max)
{
    uint32_t count = 0;
    float value;
    for (; text_float(scan, &value); count++) {
        if (count < max)
            values[count] = value;
    }
    return count;
}

void text_show(char *to, size_t size, const struct text_scan *text)
{
    text_copy(to, size, text);
    for (char *c = to; *c; c++)
        if (*c < ' ' || *c > '~')
            *c = '?';
}

void text_copy(char *to, size_t size, const struct text_scan *text)
{
    size_t length = (size_t)(text->end - text->at);
    if (length >= size)
        length = size - 1;
    for (size_t i = 0; i < length; i++)
        to[i] = text->at[i];
    for (size_t i = 0; i < length; i++) {
        if (to[i] == '\0')
            to[i] = ' ';
    }
    to[length] = '\0';
}
