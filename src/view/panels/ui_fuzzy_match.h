/* ui_fuzzy_match.h: fuzzy search of typed words in labels. */
#ifndef FIRN_VIEW_PANELS_UI_FUZZY_MATCH_H
#define FIRN_VIEW_PANELS_UI_FUZZY_MATCH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define UI_FUZZY_MATCH_NONE UINT32_MAX

/* Returns true if each word of `query` occurs in one of the texts, ignoring case. */
bool ui_fuzzy_match_contains(const char *query, const char *const *texts, size_t text_count);

/* Returns the distance of the typed words from a text, or UI_FUZZY_MATCH_NONE if one does not
 * match. A word counts 0 if the text begins with it, 1 at the start of a word, 2 inside one.
 * Otherwise its letters must occur in order from the start of a word on, and each skipped letter
 * counts: "crk cnt" matches cracks.count. With `misspelt`, one letter of each word of at least four
 * letters may be wrong. */
uint32_t ui_fuzzy_match_distance(const char *query, const char *text, bool misspelt);

#endif
