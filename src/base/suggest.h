/* suggest.h: finds the known name that is closest to a misspelt one, for error messages. */
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

/* A search for the closest name; initialise it with { .word = the unknown name }. */
struct suggest {
    const char *word;
    const char *best; /* NULL if no close name was offered; borrowed from suggest_offer() */
    size_t distance;  /* edit distance between `word` and `best` */
};

/*
 * Offers a known name as a candidate. It is close if its edit distance to the word is at most 2 and
 * below the word's length, or if they share a prefix of at least 3 characters. `best` becomes the
 * close name with the smallest distance, the first one if there are several.
 */
void suggest_offer(struct suggest *suggest, const char *name);

/* Writes ": did you mean 'BEST'?", or "" if there is no close name, to `hint`. Returns `hint`. */
const char *suggest_hint(const struct suggest *suggest, char hint[static SUGGEST_HINT_SIZE]);

/* Message text that lists the known names with their numbers: "0 'Left', 1 'Right'". Names that do
 * not fit become "...". Initialise it with {0}. */
struct suggest_list {
    char text[SUGGEST_LIST_SIZE];
    uint32_t count;
};

void suggest_list_add(struct suggest_list *list, const char *name);

/* Returns true if a word consists of digits and is a number below `count`, which *index then is. */
bool suggest_number(const char *word, uint32_t count, uint32_t *index);

#endif
