/* text.h: names in tables of a fixed width, and in files that must be UTF-8. */
#ifndef FIRN_PROFILE_TEXT_H
#define FIRN_PROFILE_TEXT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    PROFILE_COLUMNS = 100 /* of every table */
};

/* Replaces bytes that are no UTF-8, in place, by '?'. */
void profile_clean_text(char *text);

/* Writes a text and spaces up to `columns`, one column a character; if it is longer, its middle is
 * "…". Control characters, which could steer a terminal, and what is no UTF-8 become '?'. */
void profile_print_name(const char *name, uint32_t columns, FILE *out);

/* Writes lines of at most PROFILE_COLUMNS, broken between words where there are any; those after
 * the first begin with `indent` spaces. The last one ends in a newline, too. */
void profile_print_words(const char *text, uint32_t indent, FILE *out);

#endif
