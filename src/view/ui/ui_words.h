/* ui_words.h: looks for what a person typed. */
#ifndef FIRN_VIEW_UI_UI_WORDS_H
#define FIRN_VIEW_UI_UI_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* Whether each of the words, which blanks separate, is in one of the texts; capital letters count
 * as small ones. */
bool ui_words_fit(const char *words, const char *const *texts, size_t text_count);

#endif
