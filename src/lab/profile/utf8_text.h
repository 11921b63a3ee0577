/* utf8_text.h: prints UTF-8 text in columns of fixed width, and removes invalid UTF-8. */
#ifndef FIRN_LAB_PROFILE_UTF8_TEXT_H
#define FIRN_LAB_PROFILE_UTF8_TEXT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    PROFILE_COLUMNS = 100 /* width of all tables */
};

/* Replaces bytes that are not valid UTF-8 by '?', in place. */
void profile_clean_text(char *text);

/* Prints text padded with spaces to `columns` characters. In longer text, "…" replaces the middle.
 * '?' replaces invalid UTF-8 and control characters, because they are a risk in terminals. */
void profile_print_name(const char *name, uint32_t columns, FILE *out);

/* Prints text wrapped to PROFILE_COLUMNS, at word boundaries if possible, and a newline.
 * Continuation lines are indented by `indent` spaces. */
void profile_print_wrapped(const char *text, uint32_t indent, FILE *out);

#endif
