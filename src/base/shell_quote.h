/* shell_quote.h: quotes and joins command-line arguments for a shell. */
#ifndef FIRN_BASE_SHELL_QUOTE_H
#define FIRN_BASE_SHELL_QUOTE_H

#include <stdio.h>

/* Writes an argument, quoted if a shell would change it. */
void shell_quote_word(const char *word, FILE *out);

/* Returns "firn" and the quoted arguments. The caller frees the text. NULL means out of memory. */
char *shell_quote_join(char *const *args);

#endif
