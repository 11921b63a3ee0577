/* suggest.c: edit distances of names. */
#include "src/base/suggest.h"
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum {
    DISTANCE_MAX = 2,
    PREFIX_MIN = 3,
};

/* Levenshtein distance; `b` is shorter than SUGGEST_NAME_SIZE. */
static size_t edit_distance(const char *a, const char *b)
{
    size_t row[SUGGEST_NAME_SIZE];
    const size_t length = strlen(b);
    for (size_t j = 0; j <= length; j++)
        row[j] = j;
    for (size_t i = 0; a[i]; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < length; j++) {
            size_t best = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            if (best > row[j] + 1)
                best = row[j] + 1;
            if (best > row[j + 1] + 1)
                best = row[j + 1] + 1;
            row[j + 1] = best;
        }
    }
    return row[length];
}

void suggest_offer(struct suggest *suggest, const char *name)
{
    const size_t length = strlen(suggest->word);
    if (length >= SUGGEST_NAME_SIZE || strlen(name) >= SUGGEST_NAME_SIZE)
        return;
    const size_t distance = edit_distance(suggest->word, name);
    const bool is_close = (distance <= DISTANCE_MAX && distance < length) ||
                          strncmp(suggest->word, name, PREFIX_MIN) == 0;
    if (!is_close || (suggest->best && distance >= suggest->distance))
        return;
    suggest->best = name;
    suggest->distance = distance;
}

const char *suggest_hint(const struct suggest *suggest, char hint[static SUGGEST_HINT_SIZE])
{
    hint[0] = '\0';
    if (suggest->best)
        snprintf(hint, SUGGEST_HINT_SIZE, ": did you mean '%s'?", suggest->best);
    return hint;
}
