/* shell_quote.h: quotes and joins command-line arguments for a shell. */
#ifndef FIRN_BASE_SHELL_QUOTE_H
#define FIRN_BASE_SHELL_QUOTE_H

#include <stdbool.h>
#include <stdio.h>

/* Writes an argument, quoted if a shell would change it. */
void shell_quote_word(const char *word, FILE *out);

/* Returns true if an argument has control characters. Even quoted, a line break ends a comment or a
 * here-document of a script. */
bool shell_has_control(const char *word);

/* Returns "firn" and the quoted arguments. The caller frees the text. NULL means out of memory. */
char *shell_quote_join(char *const *args);

#endif
