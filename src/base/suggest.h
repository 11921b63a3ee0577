/* suggest.h: the known name that is closest to an unknown one. */
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
    const char *best; /* NULL: no close name was offered; borrowed from suggest_offer() */
    size_t distance;  /* edit distance between `word` and `best` */
};

/*
 * Offers a known name. It is close if it and the word have an edit distance of at most 2, and less
 * than the word's length, or a common prefix of at least 3 characters; `best` becomes the close
 * name with the least distance, the first one of several.
 */
void suggest_offer(struct suggest *suggest, const char *name);

/* Writes ": did you mean 'BEST'?", or "" without a close name, to `hint`. Returns `hint`. */
const char *suggest_hint(const struct suggest *suggest, char hint[static SUGGEST_HINT_SIZE]);

/* The names that there are, and their numbers, as a message lists them: "0 'Left', 1 'Right'".
 * Those that do not fit are "...". Initialise it with {0}. */
struct suggest_list {
    char text[SUGGEST_LIST_SIZE];
    uint32_t count;
};

void suggest_list_add(struct suggest_list *list, const char *name);

/* Returns whether a word is the number, in digits alone, of one of `count` things; *index is it. */
bool suggest_number(const char *word, uint32_t count, uint32_t *index);

#endif
