/*
 * text_scan.h: tokeniser for text model files: lines, words and numbers. A text is the range from a
 * start pointer to `end`, within a file in memory that ends with '\0'. Numbers are parsed in the
 * locale "C" of the reader process.
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

/* Skips blanks on a line. Returns true if anything is left. */
static inline bool text_skip(struct text_scan *scan)
{
    while (scan->at < scan->end && text_is_blank(*scan->at))
        scan->at++;
    return scan->at < scan->end;
}

/* Returns the next line without its line break ("\n", "\r\n" or "\r"), and advances past it. */
struct text_scan text_line(struct text_scan *scan);

/* Skips the next word and returns true if it is `word`, ignoring case; else returns false. */
bool text_take_word(struct text_scan *scan, const char *word);

/* Returns the rest of a line without surrounding blanks. Does not advance. */
struct text_scan text_rest(const struct text_scan *line);
/* Returns the next word on a line, or an empty text at the end, and advances past it. */
struct text_scan text_word(struct text_scan *scan);

/* Reads a float up to a blank or the end. Returns false, without advancing, if there is none. */
bool text_float(struct text_scan *scan, float *value);
/* Reads an integer; any text may follow. Returns false, without advancing, if there is none. */
bool text_integer(struct text_scan *scan, int64_t *value);

/* Reads all numbers that follow, and stores at most `max` of them. Returns how many were read. */
uint32_t text_floats(struct text_scan *scan, float *values, uint32_t max);

/* Copies a text to a string, truncated to `size` bytes including '\0'. */
void text_copy(char *to, size_t size, const struct text_scan *text);
/* Copies a text like text_copy(), but with '?' for non-printable and non-ASCII characters. */
void text_show(char *to, size_t size, const struct text_scan *text);

#endif
