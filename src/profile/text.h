/* text.h: prints text in tables of a fixed width, and cleans text for files in UTF-8. */
#ifndef FIRN_PROFILE_TEXT_H
#define FIRN_PROFILE_TEXT_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    PROFILE_COLUMNS = 100 /* of every table */
};

/* Replaces bytes that are not UTF-8, in place, by '?'. */
void profile_clean_text(char *text);

/* Writes a text padded with spaces to `columns`, one column per character; the middle of a longer
 * text is replaced by "…". Control characters, which could be commands to a terminal, and bytes
 * that are not UTF-8 become '?'. */
void profile_print_name(const char *name, uint32_t columns, FILE *out);

/* Writes a text in lines of at most PROFILE_COLUMNS, broken between words if possible; lines after
 * the first one begin with `indent` spaces. Ends with a newline. */
void profile_print_words(const char *text, uint32_t indent, FILE *out);

#endif
