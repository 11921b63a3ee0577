/* shell_words.h: command lines to read and to use again. */
#ifndef FIRN_APP_SHELL_WORDS_H
#define FIRN_APP_SHELL_WORDS_H

#include <stdio.h>

/* Writes a word as a shell takes it: quoted if it must be. */
void shell_words_quote(const char *word, FILE *out);

/* "firn" and the words, which end at NULL, quoted. The caller frees it; NULL: memory is short. */
char *shell_words_join(char *const *words);

#endif
