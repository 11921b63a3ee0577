/* suggest.c: edit distances between names, for "did you mean" hints. */
#include "src/base/suggest.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    DISTANCE_MAX = 2,
    PREFIX_MIN = 3,
};

/* Returns the Levenshtein distance; `b` must be shorter than SUGGEST_NAME_SIZE. */
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
    if (!name[0] || length >= SUGGEST_NAME_SIZE || strlen(name) >= SUGGEST_NAME_SIZE)
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

void suggest_list_add(struct suggest_list *list, const char *name)
{
    static const char more[] = ", ...";
    char words[SUGGEST_NAME_SIZE + 24];
    const size_t used = strlen(list->text);
    const char *before = list->count ? ", " : "";
    const int length = name[0] ? snprintf(words, sizeof(words), "%s%u '%.*s'", before, list->count,
                                          SUGGEST_NAME_SIZE, name)
                               : snprintf(words, sizeof(words), "%s%u", before, list->count);
    const bool is_full =
        used >= sizeof(more) && !strcmp(&list->text[used - sizeof(more) + 1], more);
    list->count++;
    if (is_full || length < 0)
        return;
    const bool fits = used + (size_t)length + sizeof(more) <= sizeof(list->text);
    snprintf(&list->text[used], sizeof(list->text) - used, "%s", fits ? words : more);
}

bool suggest_number(const char *word, uint32_t count, uint32_t *index)
{
    char *end;
    const unsigned long number = strtoul(word, &end, 10);
    *index = (uint32_t)number;
    return word[0] >= '0' && word[0] <= '9' && *end == '\0' && number < count;
}
