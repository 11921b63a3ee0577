/*
 * text_scan.h: words and numbers of model files of text, which need not end with '\0'.
 *
 * Both ends of a text are pointers; no function reads at or beyond `end`. Numbers do not depend on
 * the locale.
 */
#ifndef FIRN_SCENE_IMPORT_TEXT_SCAN_H
#define FIRN_SCENE_IMPORT_TEXT_SCAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct text_scan {
    const char *at, *end;
};

static inline bool text_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0';
}

static inline bool text_is_break(char c)
{
    return c == '\n' || c == '\r';
}

/* Skips blanks of a line; returns whether anything is left. */
static inline bool text_skip(struct text_scan *scan)
{
    while (scan->at < scan->end && text_is_blank(*scan->at))
        scan->at++;
    return scan->at < scan->end;
}

/* Returns the next line without its end, which is "\n", "\r\n" or "\r", and moves behind it. */
struct text_scan text_line(struct text_scan *scan);

/* Skips blanks, and moves behind a word, "usemtl"; returns false if another one is there. */
bool text_take_word(struct text_scan *scan, const char *word);

/* Returns what is left of a line without blanks around it, or the next word alone; its length is 0
 * at the end. */
struct text_scan text_rest(const struct text_scan *line);
struct text_scan text_word(struct text_scan *scan);

/* Read a number up to a blank or the end, or for integers up to any other character. They return
 * false, and do not move, if there is none. */
bool text_float(struct text_scan *scan, float *value);
bool text_integer(struct text_scan *scan, int64_t *value);

/* Returns how many numbers follow, of which at most `max` are stored. */
uint32_t text_floats(struct text_scan *scan, float *values, uint32_t max);

/* Copies a text to a string, cut at `size` bytes with its end; text_show() for messages, where what
 * is no printable ASCII becomes '?'. */
void text_copy(char *to, size_t size, const struct text_scan *text);
void text_show(char *to, size_t size, const struct text_scan *text);

#endif
