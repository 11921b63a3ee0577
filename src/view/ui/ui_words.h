/* ui_words.h: looks for what a person typed. */
#ifndef FIRN_VIEW_UI_UI_WORDS_H
#define FIRN_VIEW_UI_UI_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define UI_WORDS_NONE UINT32_MAX

/* Whether each of the words, which blanks separate, is in one of the texts; capital letters count
 * as small ones. */
bool ui_words_fit(const char *words, const char *const *texts, size_t text_count);

/*
 * Returns how far words are from a text; UI_WORDS_NONE: they are not in it. A word that the text
 * begins with counts nothing, one that begins a word of it 1, one within it 2. Else its letters
 * have to follow each other in the text from the beginning of a word on, with letters left out
 * between them, which count: "crk cnt" is cracks.count. With `misspelt` one letter of each word,
 * from four on, may be a wrong one.
 */
uint32_t ui_words_distance(const char *words, const char *text, bool misspelt);

#endif
