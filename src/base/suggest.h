/* suggest.h: finds the known name closest to a misspelt one, for error messages. */
#ifndef FIRN_BASE_SUGGEST_H
#define FIRN_BASE_SUGGEST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SUGGEST_NAME_SIZE = 64, /* longer names are never suggested */
    SUGGEST_LIST_SIZE = 256,
    SUGGEST_HINT_SIZE = SUGGEST_NAME_SIZE + 32, /* bytes */
};

/* State of a search for the name closest to `word`. All other members are initially zero. */
struct suggest {
    const char *word;
    const char *best; /* borrowed; NULL if there is none */
    size_t distance;  /* edit distance between `word` and `best` */
};

/*
 * Offers a known name as a suggestion. The name is a candidate if its edit distance to the word is
 * at most 2 and below the word's length. A shared prefix of 3 characters also makes the name a
 * candidate. `best` becomes the first candidate with the smallest edit distance.
 */
void suggest_offer(struct suggest *suggest, const char *name);

/* Writes ": did you mean 'BEST'?" to `hint`, or "" if there is no candidate. Returns `hint`. */
const char *suggest_hint(const struct suggest *suggest, char hint[static SUGGEST_HINT_SIZE]);

/* Text that lists known names with their numbers: "0 'Left', 1 'Right'". If names do not fit, "..."
 * replaces them. Must be initialised with zeros. */
struct suggest_list {
    char text[SUGGEST_LIST_SIZE];
    uint32_t count;
};

void suggest_list_add(struct suggest_list *list, const char *name);

/* Returns true if a word is a decimal number below `count`, and stores it in *index. */
bool suggest_number(const char *word, uint32_t count, uint32_t *index);

#endif
